// SPDX-FileCopyrightText: 2026 The fcl_kios authors
// SPDX-License-Identifier: BSD-3-Clause
#include "interior/vertex_graph.h"

#include <algorithm>
#include <utility>

#include "engine/weld.h"
#include "fcl_kios/volume/rigid.h"

namespace kios {

template <typename S>
VertexGraph::VertexGraph(const engine::MeshView<S>& mesh) {
  const std::vector<std::uint32_t> welded = engine::weld(mesh);
  std::vector<int> number(mesh.num_vertices, -1);
  const auto numberOf = [&](std::size_t t, std::size_t k) {
    const std::uint32_t v = welded[mesh.index(t, k)];
    if (number[v] < 0) {
      number[v] = static_cast<int>(points_.size());
      points_.push_back(mesh.vertices[v].template cast<double>());
    }
    return number[v];
  };
  std::vector<std::pair<int, int>> edges;
  edges.reserve(6 * mesh.num_triangles);
  for (std::size_t t = 0; t < mesh.num_triangles; ++t) {
    for (std::size_t k = 0; k < 3; ++k) {
      const int from = numberOf(t, k), to = numberOf(t, (k + 1) % 3);
      if (from == to) continue;
      edges.emplace_back(from, to);
      edges.emplace_back(to, from);
    }
  }
  std::sort(edges.begin(), edges.end());
  edges.erase(std::unique(edges.begin(), edges.end()), edges.end());
  begin_.assign(points_.size() + 1, 0);
  neighbours_.reserve(edges.size());
  for (const auto& [from, to] : edges) {
    ++begin_[static_cast<std::size_t>(from) + 1];
    neighbours_.push_back(to);
  }
  for (std::size_t i = 1; i < begin_.size(); ++i) begin_[i] += begin_[i - 1];
}

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

template VertexGraph::VertexGraph(const engine::MeshView<double>&);
template VertexGraph::VertexGraph(const engine::MeshView<float>&);

}  // namespace kios
