// SPDX-FileCopyrightText: 2026 The fcl_kios authors
// SPDX-License-Identifier: BSD-3-Clause
#include "solid/sides.h"

namespace kios {

Parts partsOf(const std::vector<Side>& sides, std::size_t num_triangles, bool across_branches) {
  const auto at = [](int i) { return static_cast<std::size_t>(i); };
  std::vector<int> parent(num_triangles, -1);
  const auto root = [&](int i) {
    while (parent[at(i)] != i) i = parent[at(i)] = parent[at(parent[at(i)])];
    return i;
  };
  forEdges(sides, [&](std::size_t begin, std::size_t end) {
    const bool joins = end - begin == 2 || across_branches;
    for (std::size_t i = begin; i < end; ++i) {
      const int t = sides[i].triangle;
      if (parent[at(t)] < 0) parent[at(t)] = t;
      if (i == begin || !joins) continue;
      const int a = root(sides[i - 1].triangle), b = root(t);
      parent[at(std::max(a, b))] = std::min(a, b);
    }
  });
  Parts parts;
  parts.of.assign(num_triangles, -1);
  for (std::size_t t = 0; t < num_triangles; ++t) {
    if (parent[t] < 0) continue;
    const std::size_t r = at(root(static_cast<int>(t)));
    parts.of[t] = r == t ? parts.count++ : parts.of[r];  // a root is the least of its part
  }
  return parts;
}

}  // namespace kios
