// SPDX-FileCopyrightText: 2026 The fcl_kios authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "build/point_lanes.h"
#include "build/principal_frame.h"
#include "fcl_kios/build/fit.h"

namespace kios {

/// The places where a fit puts the k spheres of a node, along the frame's axes, relative to its
/// middle. Sphere 0 is S0; 1, 2 lie along the shortest axis, 3, 4 along the middle one, and 5, 6,
/// which a kIOS has no place for, along the longest.
struct SphereCenters {
  static constexpr int kMost = 7;
  int k = 1;
  float sphere[kMost][3] = {};
  double least_cap_radius = 0;  ///< > 0 where all caps share a radius, as published
};

/// Returns the axis of the frame along which cap i lies, 1 <= i < k.
inline int axisOfCap(const PrincipalFrame& frame, int i) { return frame.order[2 - (i - 1) / 2]; }

/// Returns the tuned fit: S0 nearly minimal; each cap starts as a sphere through the rim of the far
/// face of the box, half opening angle 30 degrees by default, and is re-centred in its plane. At
/// most `most` spheres: 1, 3, 5 or 7.
///
///          o          centre
///         /|\         half opening angle
///        / | \        w / tan(angle) from the centre to the far face
///     +-/--+--\-+     box of the content, 2 h high
///     |/   | h \|
///     +----+----+     far face, whose rim is at most w from the axis
///      '-._ _.-'      cap
SphereCenters tunedCenters(const PointLanes& in_frame, const PrincipalFrame& frame,
                           const FitOptions& options, int most);

/// Method II as published: paper, III-B.2 and III-C.
SphereCenters publishedCenters(const PointLanes& in_frame, const PrincipalFrame& frame,
                               const FitOptions& options);

/// Method I as published: paper, III-B.1 and III-C. `frame` is that of the smallest enclosing
/// ellipsoid: its centre, axes and semi-axes a >= b >= c. Its caps have the radius a^2 / c, which
/// has no limit as the content gets flat: c is taken as a/256 at least, where what float spheres of
/// that size add to a bound by their rounding is as much as they cut off. For kMethodIAtAngle c is
/// a sin(angle) at least, the sine of the half angle under which a cap of radius a^2 / c sees a.
SphereCenters ellipsoidCenters(const PrincipalFrame& frame, const FitOptions& options);

/// Turns centres of a frame into the axes of the points that it is of: S0 relative to their origin,
/// the caps relative to S0.
SphereCenters inAxesOfPoints(const SphereCenters& in_frame, const PrincipalFrame& frame);

/// Drops pairs of caps by SphereCount::kByGain, then moves caps as FitOptions::shared_radius asks.
void adjustCenters(const PointLanes& in_frame, const PrincipalFrame& frame,
                   const FitOptions& options, SphereCenters& centers);

}  // namespace kios
