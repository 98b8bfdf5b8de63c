// SPDX-FileCopyrightText: 2026 The fcl_kios authors
// SPDX-License-Identifier: BSD-3-Clause
#include "inspect/output.h"

#include <cerrno>
#include <cstring>
#include <fstream>

namespace kios::inspect {

void requireDirectory(const std::filesystem::path& file) {
  const std::filesystem::path parent = file.parent_path();
  if (file.empty() || parent.empty() || std::filesystem::is_directory(parent)) return;
  throw OutputError(file.string() + ": there is no directory " + parent.string() + ".");
}

void writeFile(const std::filesystem::path& file, const std::string& content) {
  std::ofstream stream(file, std::ios::binary);
  stream << content;
  stream.close();
  if (!stream) {
    throw OutputError(file.string() + ": it can't be written: " + std::strerror(errno) + ".");
  }
}

}  // namespace kios::inspect
