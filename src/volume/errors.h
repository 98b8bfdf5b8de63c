// SPDX-FileCopyrightText: 2026 The fcl_kios authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <locale>
#include <sstream>
#include <stdexcept>
#include <string>

namespace kios {

/// Throws Error with "fcl_kios: " and the sentence that the parts make, one after the other.
template <typename Error = std::invalid_argument, typename... Parts>
[[noreturn, gnu::cold, gnu::noinline]] void refuse(const Parts&... parts) {
  std::ostringstream message;
  message.imbue(std::locale::classic());
  message << "fcl_kios: ";
  (message << ... << parts);
  throw Error(message.str());
}

/// Throws std::invalid_argument unless `valid`: "<name> is <value>, but must be <range>."
template <typename T>
void require(bool valid, const char* name, const T& value, const char* range) {
  if (!valid) refuse(name, " is ", value, ", but must be ", range, ".");
}

}  // namespace kios
