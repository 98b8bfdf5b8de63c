// SPDX-FileCopyrightText: 2026 The fcl_kios authors
// SPDX-License-Identifier: BSD-3-Clause
#include "tree/wide_tree.h"

#include <cmath>

namespace kios::engine {

Collapse::Collapse(const std::vector<BinaryNode>& nodes) : nodes_(nodes), costs_(nodes.size()) {
  for (int n = static_cast<int>(nodes.size()) - 1; n >= 0; --n) {  // children before parents
    const BinaryNode& node = nodes[n];
    if (node.isLeaf()) continue;  // costs nothing
    const Costs &l = costs_[node.left], &r = costs_[node.left + 1];
    Costs& c = costs_[n];
    float dissolved[kLanes + 1];
    for (int roots = 2; roots <= kLanes; ++roots) {
      const auto cost = [&](int left) { return l.at_most[left] + r.at_most[roots - left]; };
      int best = 1;
      for (int left = 2; left < roots; ++left) {
        if (cost(left) < cost(best)) best = left;
      }
      c.left[roots] = static_cast<unsigned char>(best);
      dissolved[roots] = cost(best);
    }
    c.at_most[1] = node.size * std::sqrt(node.size) + dissolved[kLanes];
    for (int roots = 2; roots <= kLanes; ++roots) {
      c.at_most[roots] = std::fmin(dissolved[roots], c.at_most[roots - 1]);
    }
  }
}

void Collapse::children(int n, std::vector<int>& out) const {
  out.clear();
  const int left = costs_[n].left[kLanes];
  dissolve(nodes_[n].left, left, out);
  dissolve(nodes_[n].left + 1, kLanes - left, out);
}

void Collapse::dissolve(int n, int roots, std::vector<int>& out) const {
  const Costs& c = costs_[n];
  while (roots > 1 && c.at_most[roots] == c.at_most[roots - 1]) --roots;  // fewer do as well
  if (nodes_[n].isLeaf() || roots == 1) {
    out.push_back(n);
    return;
  }
  dissolve(nodes_[n].left, c.left[roots], out);
  dissolve(nodes_[n].left + 1, roots - c.left[roots], out);
}

}  // namespace kios::engine
