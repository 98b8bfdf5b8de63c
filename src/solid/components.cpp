// SPDX-FileCopyrightText: 2026 The fcl_kios authors
// SPDX-License-Identifier: BSD-3-Clause
#include "solid/components.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <memory>
#include <numeric>

#include <Eigen/Geometry>

#include "fcl_kios/model/model.h"
#include "solid/winding.h"
#include "tree/weld.h"
#include "triangle/integer.h"
#include "volume/instantiate.h"

namespace kios {

// The sign of the volume, summed relative to a corner. Each term takes 8 roundings of its
// permanent, the sum one of what it adds up to for each term.
bool windInwards(std::size_t count, const CornersOf& corners_of) {
  const fcl::Vector3d origin = corners_of(0)[0];
  double volume = 0, permanents = 0;
  for (std::size_t t = 0; t < count; ++t) {
    const TriangleVertices<double> corners = corners_of(t);
    const fcl::Vector3d p = corners[0] - origin, q = corners[1] - origin, r = corners[2] - origin;
    volume += p.dot(q.cross(r));
    permanents += std::abs(p[0]) * (std::abs(q[1] * r[2]) + std::abs(q[2] * r[1])) +
                  std::abs(p[1]) * (std::abs(q[2] * r[0]) + std::abs(q[0] * r[2])) +
                  std::abs(p[2]) * (std::abs(q[0] * r[1]) + std::abs(q[1] * r[0]));
  }
  const double error = (16 + static_cast<double>(count)) * 0x1p-52 * permanents;
  if (std::isfinite(volume) && permanents > 0x1p-900 && std::abs(volume) > error) return volume < 0;
  Integer exact = 0;
  const IntegerVector from = integers(origin);
  for (std::size_t t = 0; t < count; ++t) {
    const TriangleVertices<double> p = corners_of(t);
    exact += dot(integers(p[0]) - from, cross(integers(p[1]) - from, integers(p[2]) - from));
  }
  return exact < 0;
}

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
  std::vector<Part> parts;
  for (int c = 0; c < closedness_.components; ++c) {
    const Triangles of_c = trianglesOf(c);
    const auto count = static_cast<std::size_t>(of_c.last - of_c.first);
    if (!windInwards(count, [&](std::size_t i) { return cornersOf(of_c.first[i]); })) continue;
    if (parts.empty()) parts = makeParts();
    if (!liesWithinOthers(parts, c)) inside_out_.push_back(*trianglesOf(c).begin());
  }
  closedness_.inside_out = static_cast<int>(inside_out_.size());
  if (!inside_out_.empty()) closedness_.first_inside_out = inside_out_.front();
  closedness_.oriented = inside_out_.empty();
}

template <typename S>
TriangleVertices<double> Components<S>::cornersOf(int triangle) const {
  const auto t = static_cast<std::size_t>(triangle);
  return {mesh_.corner(t, 0).template cast<double>(), mesh_.corner(t, 1).template cast<double>(),
          mesh_.corner(t, 2).template cast<double>()};
}

/// Holds the corners of a component's triangles, scaled by a power of 2 so that no length
/// overflows.
template <typename S>
struct Components<S>::Part {
  std::vector<fcl::Vector3d> corners;
  Eigen::AlignedBox3d box;
  std::shared_ptr<const Modeld> model;  ///< made where a point lies in the box
};

template <typename S>
std::vector<typename Components<S>::Part> Components<S>::makeParts() const {
  std::vector<Part> parts(begin_.size() - 1);
  double largest = 0;
  for (std::size_t c = 0; c < parts.size(); ++c) {
    for (const int t : trianglesOf(static_cast<int>(c))) {
      for (const fcl::Vector3d& p : cornersOf(t)) {
        parts[c].corners.push_back(p);
        largest = std::max(largest, p.cwiseAbs().maxCoeff());
      }
    }
  }
  const int exponent = largest > 0 ? -std::ilogb(largest) : 0;
  for (Part& part : parts) {
    for (fcl::Vector3d& p : part.corners) {
      p = p.unaryExpr([exponent](double x) { return std::scalbn(x, exponent); }).eval();
      part.box.extend(p);
    }
  }
  return parts;
}

// Returns true if the others wind round a vertex of the component that lies on none of them, or
// each lies on others, so that nothing is proven wrong. None winds round points out of its box.
template <typename S>
bool Components<S>::liesWithinOthers(std::vector<Part>& parts, int component) {
  Part& own = parts[static_cast<std::size_t>(component)];
  SearchCounts unused;
  for (const fcl::Vector3d& p : own.corners) {
    PointPlace place;
    for (Part& other : parts) {
      if (&other == &own || !other.box.contains(p)) continue;
      if (!other.model) {
        std::vector<fcl::Triangle> soup;
        for (std::size_t i = 0; i < other.corners.size(); i += 3)
          soup.emplace_back(i, i + 1, i + 2);
        other.model = makeModel(other.corners, soup);
      }
      const PointPlace here = placeOf(p, *other.model, unused);
      place.winding += here.winding;
      place.on_surface |= here.on_surface;
    }
    if (!place.on_surface) return place.inside();
  }
  return true;
}

KIOS_INSTANTIATE_CLASS(Components);

}  // namespace kios
