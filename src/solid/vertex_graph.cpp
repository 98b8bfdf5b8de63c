// SPDX-FileCopyrightText: 2026 The fcl_kios authors
// SPDX-License-Identifier: BSD-3-Clause
#include "solid/vertex_graph.h"

#include "fcl_kios/volume/rigid.h"

namespace kios {

int VertexGraph::climb(const fcl::Vector3d& n, int start) const {
  int best = start;
  double height = detail::dot(n, point(start));
  for (bool higher = true; higher;) {
    higher = false;
    const auto at = static_cast<std::size_t>(best);
    for (int i = begin_[at]; i < begin_[at + 1]; ++i) {
      const int next = neighbours_[static_cast<std::size_t>(i)];
      const double h = detail::dot(n, point(next));
      if (!(h > height)) continue;
      height = h;
      best = next;
      higher = true;
    }
  }
  return best;
}

}  // namespace kios
