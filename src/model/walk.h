// SPDX-FileCopyrightText: 2026 The fcl_kios authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <algorithm>
#include <cstddef>
#include <utility>
#include <vector>

namespace kios {

/// Walks a tree depth first, or best first: of the children of an item, or of all that waits, the
/// one of the least `bound` is next. Of children with equal bounds the one that was added last is
/// next.
///
/// skip(item) is true for an item that doesn't matter. It is asked when an item is added, and again
/// before its turn, as it may matter no longer. visit(item, add) tests a leaf, or calls add(child)
/// for each child; it returns true to end the walk. Returns the items that wait when the walk ends.
template <typename Item, typename Skip, typename Visit>
std::vector<Item> walkNearestFirst(const Item& root, const Skip& skip, const Visit& visit,
                                   bool best_first = false) {
  const auto farther = [](const Item& a, const Item& b) { return a.bound > b.bound; };
  std::vector<Item> waiting;
  waiting.reserve(64);
  waiting.push_back(root);
  std::size_t first_child = 0;
  const auto add = [&](const Item& item) {
    if (skip(item)) return;
    waiting.push_back(item);
    if (best_first) return std::push_heap(waiting.begin(), waiting.end(), farther);
    for (std::size_t i = waiting.size() - 1; i > first_child && farther(waiting[i], waiting[i - 1]);
         --i) {
      std::swap(waiting[i], waiting[i - 1]);
    }
  };
  while (!waiting.empty()) {
    if (best_first) std::pop_heap(waiting.begin(), waiting.end(), farther);
    const Item at = waiting.back();
    waiting.pop_back();
    if (skip(at)) continue;
    first_child = waiting.size();
    if (visit(at, add)) break;
  }
  return waiting;
}

}  // namespace kios
