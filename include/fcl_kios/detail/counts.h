// SPDX-FileCopyrightText: 2026 The fcl_kios authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

namespace kios {

/// Counts the work done by a search.
struct SearchCounts {
  long long expansions = 0;     ///< nodes whose children were tested
  long long volume_tests = 0;   ///< children tested
  long long leaf_pairs = 0;     ///< pairs of leaves reached
  long long leaf_kernels = 0;   ///< of these, those that no separating direction excluded
  long long exact = 0;          ///< feature and triangle pairs evaluated in double
  long long tree_searches = 0;  ///< queries in double, as floats couldn't tell of the pair

  SearchCounts& operator+=(const SearchCounts& o) {
    expansions += o.expansions;
    volume_tests += o.volume_tests;
    leaf_pairs += o.leaf_pairs;
    leaf_kernels += o.leaf_kernels;
    exact += o.exact;
    tree_searches += o.tree_searches;
    return *this;
  }
};

}  // namespace kios
