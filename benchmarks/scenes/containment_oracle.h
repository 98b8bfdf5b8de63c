// SPDX-FileCopyrightText: 2026 The fcl_kios authors
// SPDX-License-Identifier: BSD-3-Clause

#pragma once

#include <array>
#include <utility>
#include <vector>

#include <Eigen/Core>

#include "mesh.h"
#include "ray_oracle.h"

// Exact answers for a point and a closed oriented mesh, in integers of any size: the judge of
// containment. Shares no formula with the library: it intersects rays with planes and clips by
// edges (ray_oracle.h), and casts another ray where one meets an edge.

namespace kios::scenes {

/// Returns how far a triangle winds round a point: the solid angle that it fills, 1 all round, in
/// long double (Van Oosterom and Strackee 1983). Few digits are right near its edges.
long double windingOf(const std::array<Eigen::Vector3d, 3>& triangle, const Eigen::Vector3d& point);

/// All hits of a mesh, in integers of any size.
class RayOracle {
 public:
  explicit RayOracle(const Mesh& mesh);

  struct Hit : RationalRayHit {
    int triangle;
  };
  /// In the order of triangles. Those whose spheres are off the line, by a margin, are left out.
  std::vector<Hit> hits(const RationalRay& ray) const;

 private:
  std::vector<std::array<Eigen::Vector3d, 3>> triangles_;
  std::vector<std::pair<Eigen::Vector3d, double>> balls_;  ///< around the triangles
  double reach_ = 0;
};

class ContainmentOracle {
 public:
  explicit ContainmentOracle(const Mesh& mesh) : rays_(mesh) {}

  enum class Place { kOutside, kSurface, kInside };
  /// Inside is where the mesh winds round the point at least once.
  Place placeOf(const Eigen::Vector3d& point) const;

 private:
  RayOracle rays_;
};

}  // namespace kios::scenes
