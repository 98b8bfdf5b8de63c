// SPDX-FileCopyrightText: 2026 The fcl_kios authors
// SPDX-License-Identifier: BSD-3-Clause
#include "solid/near_weld.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <unordered_map>

#include "volume/errors.h"
#include "volume/instantiate.h"

namespace kios {
namespace {

/// Holds the vertices that stay, in cubes as wide as the tolerance: near ones lie in the same or in
/// neighbouring cubes. Lengths are in parts of the box's longest side, so that squares neither
/// overflow nor vanish.
template <typename S>
class StayingVertices {
 public:
  StayingVertices(const std::vector<fcl::Vector3<S>>& vertices, const Eigen::AlignedBox3d& box,
                  double side, double tolerance)
      : vertices_(vertices),
        low_(box.min()),
        side_(side),
        square_(tolerance * tolerance),
        // Wider by more than rounding, and not so small that indices overflow.
        cube_(std::max(tolerance * (1 + 0x1p-20), 0x1p-30)) {}

  /// Returns the nearest one within the tolerance, of equally near ones the first; -1 if there is
  /// none. Within 0 lie equal ones alone.
  int nearest(int vertex) const {
    const Cube at = cubeOf(scaled(vertex));
    int best = -1;
    double least = square_;
    Cube c;
    for (c[0] = at[0] - 1; c[0] <= at[0] + 1; ++c[0]) {
      for (c[1] = at[1] - 1; c[1] <= at[1] + 1; ++c[1]) {
        for (c[2] = at[2] - 1; c[2] <= at[2] + 1; ++c[2]) {
          const auto found = cubes_.find(c);
          if (found == cubes_.end()) continue;
          for (const int other : found->second) {
            const double square = ((point(other) - point(vertex)) / side_).squaredNorm();
            if (square > least || (square == least && best >= 0 && best < other)) continue;
            if (square_ == 0 && point(other) != point(vertex)) continue;
            least = square;
            best = other;
          }
        }
      }
    }
    return best;
  }
  void add(int vertex) { cubes_[cubeOf(scaled(vertex))].push_back(vertex); }

 private:
  using Cube = std::array<std::int64_t, 3>;
  struct Hash {
    std::size_t operator()(const Cube& c) const {
      std::uint64_t h = 0;
      for (const std::int64_t i : c) {
        h = (h ^ static_cast<std::uint64_t>(i)) * 0x9E3779B97F4A7C15U;
        h ^= h >> 32;
      }
      return h;
    }
  };

  Eigen::Vector3d point(int vertex) const {
    return vertices_[static_cast<std::size_t>(vertex)].template cast<double>();
  }
  Eigen::Vector3d scaled(int vertex) const { return (point(vertex) - low_) / side_; }
  Cube cubeOf(const Eigen::Vector3d& p) const {
    Cube c;
    for (int i = 0; i < 3; ++i) {
      c[static_cast<std::size_t>(i)] = static_cast<std::int64_t>(std::floor(p[i] / cube_));
    }
    return c;
  }

  const std::vector<fcl::Vector3<S>>& vertices_;
  const Eigen::Vector3d low_;
  const double side_, square_, cube_;
  std::unordered_map<Cube, std::vector<int>, Hash> cubes_;
};

}  // namespace

template <typename S>
NearWeld weldNear(const std::vector<fcl::Vector3<S>>& vertices, const std::vector<bool>& used,
                  double relative, double absolute, bool only_equal) {
  NearWeld weld;
  weld.by.assign(vertices.size(), -1);
  Eigen::AlignedBox3d box;
  for (std::size_t i = 0; i < vertices.size(); ++i) {
    if (used[i]) box.extend(vertices[i].template cast<double>());
  }
  if (box.isEmpty()) return weld;
  double side = box.sizes().maxCoeff();
  if (!std::isfinite(side)) refuse("a mesh is too large to be repaired.");
  weld.tolerance =
      std::max(absolute, relative * side * (box.sizes() / (side > 0 ? side : 1)).norm());
  if (!(side > 0)) side = 1;
  StayingVertices<S> staying(vertices, box, side,
                             only_equal ? 0 : std::min(weld.tolerance / side, 2.0));
  const int count = static_cast<int>(vertices.size());
  for (int i = 0; i < count; ++i) {
    if (!used[static_cast<std::size_t>(i)] || staying.nearest(i) >= 0) continue;
    staying.add(i);
    weld.by[static_cast<std::size_t>(i)] = i;
  }
  for (int i = 0; i < count; ++i) {
    const auto at = static_cast<std::size_t>(i);
    if (!used[at] || weld.by[at] == i) continue;
    weld.by[at] = staying.nearest(i);
    ++weld.welded;
    const auto &from = vertices[at], &to = vertices[static_cast<std::size_t>(weld.by[at])];
    if (from == to) continue;
    ++weld.moved;
    const double way =
        side * ((to.template cast<double>() - from.template cast<double>()) / side).norm();
    if (weld.farthest_vertex >= 0 && !(way > weld.farthest)) continue;
    weld.farthest = way;
    weld.farthest_vertex = i;
  }
  return weld;
}

KIOS_INSTANTIATE_FUNCTION(weldNear);

}  // namespace kios
