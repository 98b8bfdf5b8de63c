// SPDX-FileCopyrightText: 2026 The fcl_kios authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "clearance/sphere_intersection.h"
#include "fcl_kios/clearance.h"

namespace kios::exact {

/// Nearest points of two bodies, in units of 2^exponent, relative to a's S0 centre in frame A.
struct NearestPair {
  int exponent = 0;
  /// Proven: no point of a is nearer to one of b, if the offset is as given. <= 0: not apart.
  double lower = 0;
  double upper = 0;  ///< |q - p|, plus the distances of p and q to their bodies
  Vector3d p = Vector3d::Zero(), q = Vector3d::Zero();
  Vector3d normal = Vector3d::Zero();  ///< unit, from a to b
  Vector3d q_arm = Vector3d::Zero();   ///< q from b's S0 centre, in frame A
  int probes = 0;                      ///< support points computed, of each body
};

/// b sits at R x + offset, offset the vector between the S0 centres in frame A, a finite length.
NearestPair nearestPair(const SphereIntersection& a, const SphereIntersection& b, const Matrix3d& R,
                        const Vector3d& offset);

/// exactDistance() of volumes that aren't empty and whose bodies were made before.
template <typename S>
ExactDistance exactDistance(const kIOS<S>& a, const SphereIntersection& body_a, const kIOS<S>& b,
                            const SphereIntersection& body_b, const RelativePose<S>& X_AB);

}  // namespace kios::exact
