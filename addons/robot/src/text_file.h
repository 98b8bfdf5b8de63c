// SPDX-FileCopyrightText: 2026 The fcl_kios authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <string>

#include <fcl/common/types.h>

namespace kios::robot {

/// Throws std::invalid_argument with a sentence about a file.
[[noreturn]] void refuse(const std::string& what);
/// Throws likewise, with the place: "file:line: what".
[[noreturn]] void refuseAt(const std::string& file, int line, const std::string& what);

/// The content of a file. Throws std::invalid_argument if it can't be read, is a directory, empty,
/// or longer than `most` bytes.
std::string contentOf(const std::string& file, std::size_t most = std::size_t{1} << 28);

/// Reads `count` finite numbers, with white space around them and nothing else, whatever the
/// locale; false if the text isn't that.
bool parseNumbers(const std::string& text, int count, double* numbers);

/// A rigid pose with its rotation orthonormal to rounding: a quaternion's, as a linkage would take
/// it. Throws std::invalid_argument if it isn't rigid or not finite; `what` is part of the message.
fcl::Transform3d rigid(const fcl::Transform3d& X, const std::string& what);
/// Multiplies two such poses.
fcl::Transform3d rigidProduct(const fcl::Transform3d& X, const fcl::Transform3d& Y);

}  // namespace kios::robot
