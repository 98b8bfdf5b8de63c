// SPDX-FileCopyrightText: 2026 The fcl_kios authors
// SPDX-License-Identifier: BSD-3-Clause
#include "solid/components.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <numeric>
#include <optional>

#include "solid/nesting.h"
#include "tree/weld.h"
#include "triangle/integer.h"
#include "volume/instantiate.h"

namespace kios {

template <typename S>
Components<S>::Components(const engine::MeshView<S>& mesh) : mesh_(mesh) {
  const std::vector<std::uint32_t> welded = engine::weld(mesh);
  const std::vector<Side> sides = sidesOf(mesh.num_triangles, [&](std::size_t t) {
    return std::array{welded[mesh.index(t, 0)], welded[mesh.index(t, 1)], welded[mesh.index(t, 2)]};
  });
  listTriangles(partsOf(sides, mesh.num_triangles, true));
  judgeEdges(sides);
  if (closedness_.closed && closedness_.oriented) findInsideOut();
}

// Triangles that are points have no side, and are of no component.
template <typename S>
void Components<S>::listTriangles(const Parts& parts) {
  closedness_.components = parts.count;
  begin_.assign(static_cast<std::size_t>(parts.count) + 1, 0);
  for (const int c : parts.of) {
    if (c >= 0) ++begin_[static_cast<std::size_t>(c) + 1];
  }
  std::partial_sum(begin_.begin(), begin_.end(), begin_.begin());
  std::vector<int> next = begin_;
  triangles_.resize(static_cast<std::size_t>(begin_.back()));
  for (std::size_t t = 0; t < parts.of.size(); ++t) {
    if (parts.of[t] < 0) continue;
    int& place = next[static_cast<std::size_t>(parts.of[t])];
    triangles_[static_cast<std::size_t>(place++)] = static_cast<int>(t);
  }
}

template <typename S>
void Components<S>::judgeEdges(const std::vector<Side>& sides) {
  std::vector<const Side*> faulty;
  forEdges(sides, [&](std::size_t begin, std::size_t end) {
    int forward = 0;
    for (std::size_t i = begin; i < end; ++i) forward += sides[i].forward ? 1 : 0;
    const int count = static_cast<int>(end - begin);
    ++closedness_.edges;
    if (count > 2) ++closedness_.branching_edges;
    if (count % 2 == 1) {
      ++closedness_.open_edges;
    } else if (2 * forward != count) {
      ++closedness_.misoriented_edges;
    } else {
      return;
    }
    faulty.push_back(&sides[begin]);
  });
  const std::size_t shown = std::min(faulty.size(), closedness_.first.size());
  std::partial_sort(faulty.begin(), faulty.begin() + static_cast<std::ptrdiff_t>(shown),
                    faulty.end(), [](const Side* a, const Side* b) {
                      return a->triangle != b->triangle ? a->triangle < b->triangle
                                                        : a->corner < b->corner;
                    });
  for (std::size_t i = 0; i < shown; ++i) {
    const auto triangle = static_cast<std::size_t>(faulty[i]->triangle);
    const std::size_t corner = faulty[i]->corner;
    closedness_.first[i] = {faulty[i]->triangle, mesh_.corner(triangle, corner),
                            mesh_.corner(triangle, (corner + 1) % 3)};
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
    if (!nesting->liesWithinOthers(c)) inside_out_.push_back(*trianglesOf(c).begin());
  }
  closedness_.inside_out = static_cast<int>(inside_out_.size());
  if (!inside_out_.empty()) closedness_.first_inside_out = inside_out_.front();
  closedness_.oriented = inside_out_.empty();
}

// The sign of the volume, summed relative to a vertex of the component. Each term takes 8 roundings
// of its permanent, the sum one of what it adds up to for each term.
template <typename S>
bool Components<S>::windsInwards(int component) const {
  const fcl::Vector3<S>& o =
      mesh_.corner(static_cast<std::size_t>(*trianglesOf(component).begin()), 0);
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
  Integer exact = 0;
  const IntegerVector from = integers(origin);
  triangles([&](std::size_t t) {
    IntegerVector p[3];
    for (std::size_t k = 0; k < 3; ++k) {
      p[k] = integers(mesh_.corner(t, k).template cast<double>()) - from;
    }
    exact += dot(p[0], cross(p[1], p[2]));
  });
  return exact < 0;
}

KIOS_INSTANTIATE_CLASS(Components);

}  // namespace kios
