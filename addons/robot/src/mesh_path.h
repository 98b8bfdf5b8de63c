// SPDX-FileCopyrightText: 2026 The fcl_kios authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <map>
#include <string>

namespace kios::robot {

/// The file that a URDF or a scene names: package://name/rest, model://, file://, absolute, or
/// relative to the folder of `named_in` or one above it. Throws std::invalid_argument if there is
/// none, with the remedy but without the place.
std::string resolve(const std::string& uri, const std::string& named_in,
                    const std::map<std::string, std::string>& packages);

}  // namespace kios::robot
