// SPDX-FileCopyrightText: 2026 The fcl_kios authors
// SPDX-License-Identifier: BSD-3-Clause
#include "solid/components.h"

#include <algorithm>
#include <boost/multiprecision/cpp_int.hpp>
#include <cmath>
#include <numeric>
#include <optional>

#include "solid/nesting.h"
#include "tree/weld.h"
#include "triangle/integer.h"

namespace kios {
namespace {

using boost::multiprecision::cpp_int;

int findRoot(std::vector<int>& parent, int i) {
  while (parent[static_cast<std::size_t>(i)] != i) {
    int& p = parent[static_cast<std::size_t>(i)];
    p = parent[static_cast<std::size_t>(p)];
    i = p;
  }
  return i;
}

}  // namespace

template <typename S>
Components<S>::Components(const engine::MeshView<S>& mesh)
    : mesh_(mesh), welded_(engine::weld(mesh)) {
  halves_.reserve(3 * mesh.num_triangles);
  for (std::size_t t = 0; t < mesh.num_triangles; ++t) {
    for (std::size_t k = 0; k < 3; ++k) {
      const std::uint32_t from = welded_[mesh.index(t, k)],
                          to = welded_[mesh.index(t, (k + 1) % 3)];
      if (from == to) continue;
      halves_.push_back({std::min(from, to), std::max(from, to), static_cast<std::uint32_t>(t),
                         static_cast<std::uint32_t>(k), from < to});
    }
  }
  std::sort(halves_.begin(), halves_.end());
  connect();
  judgeEdges();
  if (closedness_.closed && closedness_.oriented) findInsideOut();
  halves_ = {};
}

template <typename S>
void Components<S>::connect() {
  std::vector<int> parent(mesh_.num_triangles);
  std::iota(parent.begin(), parent.end(), 0);
  for (std::size_t i = 1; i < halves_.size(); ++i) {
    if (!halves_[i].sameEdge(halves_[i - 1])) continue;
    const int a = findRoot(parent, static_cast<int>(halves_[i - 1].triangle)),
              b = findRoot(parent, static_cast<int>(halves_[i].triangle));
    parent[static_cast<std::size_t>(std::max(a, b))] = std::min(a, b);
  }
  // A root is the least of its component, so that components are numbered in the triangles' order.
  // Triangles that are points have no edge, and are of no component.
  component_.assign(mesh_.num_triangles, -1);
  std::vector<int> number(mesh_.num_triangles, 0);
  for (std::size_t t = 0; t < mesh_.num_triangles; ++t) {
    const std::uint32_t a = welded_[mesh_.index(t, 0)];
    if (a == welded_[mesh_.index(t, 1)] && a == welded_[mesh_.index(t, 2)]) continue;
    const auto root = static_cast<std::size_t>(findRoot(parent, static_cast<int>(t)));
    if (root == t) {
      number[t] = static_cast<int>(first_.size());
      first_.push_back(static_cast<int>(t));
    }
    component_[t] = number[root];
  }
  closedness_.components = static_cast<int>(first_.size());
  begin_.assign(first_.size() + 1, 0);
  for (const int c : component_) {
    if (c >= 0) ++begin_[static_cast<std::size_t>(c) + 1];
  }
  std::partial_sum(begin_.begin(), begin_.end(), begin_.begin());
  std::vector<int> next = begin_;
  triangles_.resize(static_cast<std::size_t>(begin_.back()));
  for (std::size_t t = 0; t < mesh_.num_triangles; ++t) {
    if (component_[t] < 0) continue;
    triangles_[static_cast<std::size_t>(next[static_cast<std::size_t>(component_[t])]++)] =
        static_cast<int>(t);
  }
}

template <typename S>
void Components<S>::judgeEdges() {
  std::vector<const Half*> faulty;
  for (std::size_t i = 0, end = 0; i < halves_.size(); i = end) {
    int forward = 0;
    while (end < halves_.size() && halves_[end].sameEdge(halves_[i])) {
      forward += halves_[end++].forward ? 1 : 0;
    }
    const int count = static_cast<int>(end - i);
    ++closedness_.edges;
    if (count > 2) ++closedness_.branching_edges;
    if (count % 2 == 1) {
      ++closedness_.open_edges;
    } else if (2 * forward != count) {
      ++closedness_.misoriented_edges;
    } else {
      continue;
    }
    faulty.push_back(&halves_[i]);
  }
  const std::size_t shown = std::min(faulty.size(), closedness_.first.size());
  std::partial_sort(faulty.begin(), faulty.begin() + static_cast<std::ptrdiff_t>(shown),
                    faulty.end(), [](const Half* a, const Half* b) {
                      return a->triangle != b->triangle ? a->triangle < b->triangle
                                                        : a->corner < b->corner;
                    });
  for (std::size_t i = 0; i < shown; ++i) {
    const Half& half = *faulty[i];
    closedness_.first[i] = {static_cast<int>(half.triangle),
                            mesh_.corner(half.triangle, half.corner),
                            mesh_.corner(half.triangle, (half.corner + 1) % 3)};
  }
  closedness_.closed = closedness_.edges > 0 && closedness_.open_edges == 0;
  closedness_.oriented = closedness_.edges > 0 && closedness_.misoriented_edges == 0;
}

template <typename S>
void Components<S>::findInsideOut() {
  std::optional<Nesting<S>> nesting;
  for (int c = 0; c < closedness_.components; ++c) {
    if (!windsInwards(c)) continue;
    if (!nesting) nesting.emplace(mesh_, *this);
    if (!nesting->liesWithinOthers(c)) inside_out_.push_back(first_[static_cast<std::size_t>(c)]);
  }
  closedness_.inside_out = static_cast<int>(inside_out_.size());
  if (!inside_out_.empty()) closedness_.first_inside_out = inside_out_.front();
  closedness_.oriented = inside_out_.empty();
}

// The sign of the volume, summed relative to a vertex of the component. Each term takes 8 roundings
// of its permanent, the sum one of what it adds up to for each term.
template <typename S>
bool Components<S>::windsInwards(int component) const {
  const fcl::Vector3<S>& o = mesh_.corner(static_cast<std::size_t>(first_[component]), 0);
  const fcl::Vector3d origin = o.template cast<double>();
  double volume = 0, permanents = 0, terms = 0;
  const auto triangles = [&](const auto& visit) {
    for (const int t : trianglesOf(component)) visit(static_cast<std::size_t>(t));
  };
  triangles([&](std::size_t t) {
    fcl::Vector3d p[3];
    for (std::size_t k = 0; k < 3; ++k) {
      p[k] = mesh_.corner(t, k).template cast<double>() - origin;
    }
    const fcl::Vector3d q = p[1].cwiseAbs(), r = p[2].cwiseAbs();
    volume += p[0].dot(p[1].cross(p[2]));
    permanents += std::abs(p[0][0]) * (q[1] * r[2] + q[2] * r[1]) +
                  std::abs(p[0][1]) * (q[2] * r[0] + q[0] * r[2]) +
                  std::abs(p[0][2]) * (q[0] * r[1] + q[1] * r[0]);
    ++terms;
  });
  const double error = (16 + terms) * 0x1p-52 * permanents;
  if (std::isfinite(volume) && permanents > 0x1p-900 && std::abs(volume) > error) return volume < 0;
  cpp_int exact = 0, from[3];
  for (int c = 0; c < 3; ++c) from[c] = integer(origin[c]);
  triangles([&](std::size_t t) {
    cpp_int p[3][3];
    for (std::size_t k = 0; k < 3; ++k) {
      for (int c = 0; c < 3; ++c) p[k][c] = integer(double{mesh_.corner(t, k)[c]}) - from[c];
    }
    exact += p[0][0] * (p[1][1] * p[2][2] - p[1][2] * p[2][1]) +
             p[0][1] * (p[1][2] * p[2][0] - p[1][0] * p[2][2]) +
             p[0][2] * (p[1][0] * p[2][1] - p[1][1] * p[2][0]);
  });
  return exact < 0;
}

template class Components<double>;
template class Components<float>;

}  // namespace kios
