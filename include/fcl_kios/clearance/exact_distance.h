// SPDX-FileCopyrightText: 2026 The fcl_kios authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "fcl_kios/volume/kios.h"
#include "fcl_kios/volume/separation.h"

namespace kios {

/// Distance of two k-IOS as volumes: not a bound of it by sphere pairs, as separation() is. Numbers
/// are double for both scalars. Source: paper, III-D (properties 1 to 5) and VI.
struct ExactDistance {
  /// Proven lower bound of the distance of the contents: 0 when the volumes meet, +infinity when
  /// one is empty. Never below separation().
  double distance = 0;
  /// The volumes' true distance is within [distance, distance + error]. In double that is 1e-12 of
  /// the pair's size (reaches of the caps and all) plus 200 roundings of its coordinates; in float
  /// those roundings, of 2^-24, are the larger part. 1e-6 where two spheres of a volume touch from
  /// outside, so that it depends on their radii by a square root; 1e-3 where four do.
  double error = 0;
  /// Nearest points of a and of b in frame A: unique while the volumes are apart; when they meet, a
  /// point of each, `error` apart. On the volumes to the same accuracy.
  fcl::Vector3d p = fcl::Vector3d::Zero();
  fcl::Vector3d q = fcl::Vector3d::Zero();
  /// Unit vector from a to b in frame A: the derivative by B's translation in A (T of X_AB). When
  /// distance = 0 there is no derivative: normal and moment are zero.
  fcl::Vector3d normal = fcl::Vector3d::Zero();
  /// Moment of the normal, (q - T) x normal: the derivative by a rotation vector w in frame A that
  /// turns B about its own origin, R -> exp([w]) R. About a point c of frame A instead: (q - c) x
  /// normal.
  fcl::Vector3d moment = fcl::Vector3d::Zero();

  /// Returns true if the volumes are proven to have no point in common.
  bool apart() const { return distance > 0; }
};

/// Returns the distance of a, in frame A, to b, in frame B. A point x of B is R x + T in A, with R
/// and T as given. C1 in the pose while the volumes are apart, with (normal, moment) as gradient;
/// piecewise smooth beyond. Also covers the rounding of b's points on their way to frame A.
template <typename S>
ExactDistance exactDistance(const kIOS<S>& a, const kIOS<S>& b, const RelativePose<S>& X_AB);
/// Takes both in one frame; the moment is about its origin.
template <typename S>
ExactDistance exactDistance(const kIOS<S>& a, const kIOS<S>& b);

/// Finds the point of `volume` nearest to `point`: distance, p (on the volume), q = point; the
/// normal points from the volume to the point, which is the gradient by the point; no moment.
/// Distance 0 and p = point if the point is inside. Throws std::invalid_argument if a coordinate is
/// NaN, infinite, or above 2^1000 (double) or 2^120 (float) in magnitude.
template <typename S>
ExactDistance nearestPoint(const kIOS<S>& volume, const fcl::Vector3<S>& point);

}  // namespace kios
