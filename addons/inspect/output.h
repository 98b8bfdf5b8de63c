// SPDX-FileCopyrightText: 2026 The fcl_kios authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <filesystem>
#include <stdexcept>
#include <string>

namespace kios::inspect {

/// An error with the exit code by which the program ends.
struct ExitError : std::runtime_error {
  ExitError(const std::string& text, int code) : std::runtime_error(text), exit_code(code) {}
  const int exit_code;
};
template <int kCode>
struct ErrorOf final : ExitError {
  explicit ErrorOf(const std::string& text) : ExitError(text, kCode) {}
};
using UsageError = ErrorOf<2>;
using InputError = ErrorOf<3>;   ///< a file can't be read, or its content is not a mesh
using OutputError = ErrorOf<4>;  ///< a file can't be written

/// Refuses a missing folder, the commonest reason why a file can't be written, before minutes of
/// work. Nothing is asked of an empty path.
void requireDirectory(const std::filesystem::path& file);

/// Writes all of it or throws OutputError.
void writeFile(const std::filesystem::path& file, const std::string& content);

}  // namespace kios::inspect
