// SPDX-FileCopyrightText: 2026 The fcl_kios authors
// SPDX-License-Identifier: BSD-3-Clause

#pragma once

#include <array>
#include <optional>

#include <Eigen/Core>

// Exact answers for a ray and a triangle of doubles, in integers of any size: the judge of ray
// queries. Shares no formula with them: it intersects with the plane first and clips by edges.

namespace kios::scenes {

/// Holds origin + t direction, t_min <= t <= t_max, all finite.
struct RationalRay {
  Eigen::Vector3d origin, direction;
  double t_min, t_max;
};

struct RationalRayHit {
  /// Is the least t of a common point, rounded once; neither under- nor overflows where it has 15
  /// exponent bits.
  long double t;
  bool crosses;  ///< the ray leaves the triangle's plane, so that the following are set
  bool along_normal;
  std::array<long double, 3> weights;  ///< barycentric
};

/// Returns none if the ray doesn't meet the closed triangle, which may be a segment or a point.
std::optional<RationalRayHit> rationalRayHit(const RationalRay& ray,
                                             const std::array<Eigen::Vector3d, 3>& triangle);

}  // namespace kios::scenes
