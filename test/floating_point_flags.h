// SPDX-FileCopyrightText: 2026 The fcl_kios authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <gtest/gtest.h>

#include <cfenv>
#include <cstdint>
#include <map>
#include <string>

// Programs that trap invalid operations and divisions by zero, as simulations do: no build and no
// query of ours may raise these flags, in whatever lane of a vector.

namespace kios::testing {

/// Counts the calls that raise a flag, by their names.
class Flags {
 public:
  template <typename Ask>
  void during(const std::string& name, const Ask& ask) {
    fillStack();
    std::feclearexcept(FE_ALL_EXCEPT);
    ask();
    const int raised = std::fetestexcept(FE_INVALID | FE_DIVBYZERO);
    std::feclearexcept(FE_ALL_EXCEPT);
    ++calls_;
    if (raised == 0) return;
    Count& count = counts_[name];
    count.invalid += (raised & FE_INVALID) != 0 ? 1 : 0;
    count.divisions += (raised & FE_DIVBYZERO) != 0 ? 1 : 0;
  }
  ~Flags() {
    EXPECT_GT(calls_, 0);
    for (const auto& [name, count] : counts_) {
      ADD_FAILURE() << name << ": " << count.invalid << " calls raise FE_INVALID, "
                    << count.divisions << " FE_DIVBYZERO, of " << calls_ << " in all";
    }
  }

 private:
  /// Leaves signalling NaN, of float and of double, where the next call keeps its variables: what
  /// reads them before they are set is seen.
  __attribute__((noinline)) static void fillStack() {
    constexpr std::uint64_t kNaN = 0x7FF400007FA00000U;
    volatile std::uint64_t words[1 << 15];
    for (volatile std::uint64_t& word : words) word = kNaN;
  }

  struct Count {
    int invalid = 0, divisions = 0;
  };
  std::map<std::string, Count> counts_;
  int calls_ = 0;
};

}  // namespace kios::testing
