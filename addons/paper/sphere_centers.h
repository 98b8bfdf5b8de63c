// SPDX-FileCopyrightText: 2026 The fcl_kios authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <Eigen/Core>
#include <array>

#include "fcl_kios/paper.h"

namespace kios {

/// Principal axes of a point set and the box along them.
struct PrincipalFrame {
  Eigen::Matrix3d axes = Eigen::Matrix3d::Identity();  ///< columns: orthonormal axes
  Eigen::Vector3d middle = Eigen::Vector3d::Zero();    ///< of the box, along each axis
  Eigen::Vector3d half = Eigen::Vector3d::Zero();      ///< half extent along each axis
  std::array<int, 3> order = {0, 1, 2};                ///< axes by decreasing extent
};

/// The frame of points by their covariance (paper, III-B.2), and the points in it, relative to the
/// middle.
PrincipalFrame principalFrame(const Eigen::Matrix3Xd& points, Eigen::Matrix3Xd& in_frame);

/// The places where a fit puts the k spheres of a node, along the frame's axes, relative to its
/// middle. Sphere 0 is S0; 1, 2 lie along the shortest axis, 3, 4 along the middle one, and 5, 6,
/// which a kIOS has no place for, along the longest.
struct SphereCenters {
  static constexpr int kMost = 7;
  int k = 1;
  Eigen::Vector3d sphere[kMost];
  double least_cap_radius = 0;  ///< > 0 where all caps share a radius, as published

  SphereCenters() {
    for (Eigen::Vector3d& s : sphere) s.setZero();
  }
};

/// Returns the axis of the frame along which cap i lies, 1 <= i < k.
inline int axisOfCap(const PrincipalFrame& frame, int i) { return frame.order[2 - (i - 1) / 2]; }

/// Returns the tuned fit (lane_fit.h draws a cap): S0 nearly minimal; each cap starts as a sphere
/// through the rim of the far face of the box and is re-centred in its plane. At most `most`
/// spheres: 1, 3, 5 or 7.
SphereCenters tunedCenters(const Eigen::Matrix3Xd& in_frame, const PrincipalFrame& frame,
                           const FitOptions& options, int most);

/// Method II as published: paper, III-B.2 and III-C.
SphereCenters publishedCenters(const Eigen::Matrix3Xd& in_frame, const PrincipalFrame& frame,
                               const FitOptions& options);

/// Method I as published: paper, III-B.1 and III-C. `frame` is that of the smallest enclosing
/// ellipsoid: its centre, axes and semi-axes a >= b >= c. Its caps have the radius a^2 / c, which
/// has no limit as the content gets flat: c is taken as a/256 at least, where what float spheres of
/// that size add to a bound by their rounding is as much as they cut off. For kMethodIAtAngle c is
/// a sin(angle) at least, the sine of the half angle under which a cap of radius a^2 / c sees a.
SphereCenters ellipsoidCenters(const PrincipalFrame& frame, const FitOptions& options);

/// Drops pairs of caps by SphereCount::kByGain, then moves caps as FitOptions::shared_radius asks.
void adjustCenters(const Eigen::Matrix3Xd& in_frame, const PrincipalFrame& frame,
                   const FitOptions& options, SphereCenters& centers);

/// Points relative to the first of them, in units of 2^exponent. Throws std::invalid_argument for
/// those that kios::fit() refuses.
struct RelativePoints {
  Eigen::Matrix3Xd p;
  int exponent = 0;

  template <typename S>
  RelativePoints(const fcl::Vector3<S>* points, int n);
};

/// Places at most `most` spheres (7 by the tuned fit alone) in the points' axes: the first relative
/// to points[0], the others to the first.
SphereCenters placeCenters(const Eigen::Matrix3Xd& points, const FitOptions& options, int most);

/// Throws std::invalid_argument if the angle is not in [1/256, pi/2).
void requireUsable(const FitOptions& options);

}  // namespace kios
