// SPDX-FileCopyrightText: 2026 The fcl_kios authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <algorithm>
#include <atomic>

namespace kios::engine {

/// Bounds the tests of volumes that queries make without a tree, before it would have paid to make
/// one: at most twice the work is done that was needed. Any thread may call these.
class BuildBudget {
 public:
  /// Returns the tests that are left to a model of so many triangles; 0 after exhaust().
  long long remaining(long long num_triangles) const {
    if (exhausted_.load(std::memory_order_relaxed)) return 0;
    return std::max(0LL, price(num_triangles) - charged_.load(std::memory_order_relaxed));
  }

  /// Returns true if queries have made as many tests since the last exhaust() as a tree takes of so
  /// many triangles.
  bool isSpent(long long num_triangles) const {
    return charged_.load(std::memory_order_relaxed) >= price(num_triangles);
  }

  /// Adds the tests of a query that ran without a tree.
  void charge(long long tests) { charged_.fetch_add(tests, std::memory_order_relaxed); }

  /// Ends the budget, as a tree was made, or costs next to nothing: an equal one is held elsewhere.
  void exhaust() {
    exhausted_.store(true, std::memory_order_relaxed);
    charged_.store(0, std::memory_order_relaxed);
  }

 private:
  static long long price(long long num_triangles) {
    // A test takes 50 ns; a tree 0.2 us a triangle, and the first of them 2 us.
    constexpr long long kTestsATriangle = 4, kTestsATree = 32;
    constexpr long long kMost = 1 << 28;  // FCL's nodes count in ints
    return std::min(kTestsATree + kTestsATriangle * num_triangles, kMost);
  }

  std::atomic<bool> exhausted_{false};
  std::atomic<long long> charged_{0};
};

}  // namespace kios::engine
