// SPDX-FileCopyrightText: 2026 The fcl_kios authors
// SPDX-License-Identifier: BSD-3-Clause
#include "solid/sides.h"

#include <utility>

namespace kios {

Parts partsOf(const std::vector<Side>& sides, std::size_t num_triangles, bool across_branches) {
  const auto at = [](int i) { return static_cast<std::size_t>(i); };
  Parts parts;
  parts.of.assign(num_triangles, -1);
  parts.turned.assign(num_triangles, false);
  std::vector<int> parent(num_triangles, -1);
  std::vector<bool>& turned = parts.turned;  // against the parent
  // The root is the parent from then on.
  const auto root = [&](int i) {
    int r = i;
    bool to_root = false;
    for (; parent[at(r)] != r; r = parent[at(r)]) to_root ^= turned[at(r)];
    while (parent[at(i)] != r) {
      const int next = std::exchange(parent[at(i)], r);
      const bool to_next = turned[at(i)];
      turned[at(i)] = to_root;
      to_root ^= to_next;
      i = next;
    }
    return r;
  };
  forEdges(sides, [&](std::size_t begin, std::size_t end) {
    const bool joins = end - begin == 2 || across_branches;
    for (std::size_t i = begin; i < end; ++i) {
      const int t = sides[i].triangle;
      if (parent[at(t)] < 0) parent[at(t)] = t;
      if (i == begin || !joins) continue;
      const int last = sides[i - 1].triangle, a = root(last), b = root(t);
      if (a == b) continue;
      const bool same_way = sides[i - 1].forward == sides[i].forward;
      turned[at(std::max(a, b))] = turned[at(last)] ^ turned[at(t)] ^ same_way;
      parent[at(std::max(a, b))] = std::min(a, b);
    }
  });
  for (std::size_t t = 0; t < num_triangles; ++t) {
    if (parent[t] < 0) continue;
    const std::size_t r = at(root(static_cast<int>(t)));  // the least of its part
    if (r == t) parts.triangles.emplace_back();
    parts.of[t] = r == t ? static_cast<int>(parts.triangles.size()) - 1 : parts.of[r];
    parts.triangles[at(parts.of[t])].push_back(static_cast<int>(t));
  }
  return parts;
}

}  // namespace kios
