// SPDX-FileCopyrightText: 2026 The fcl_kios authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "fit/point_lanes.h"
#include "fit/principal_frame.h"

namespace kios {

/// Where a fit puts the spheres of a node: k of them, along the frame's axes, relative to its
/// middle. Sphere 0 is S0; 1, 2 lie along the shortest axis, 3, 4 along the middle one.
struct SphereCenters {
  int k = 1;
  float sphere[5][3] = {};
  double least_cap_radius = 0;  ///< > 0 where all caps share a radius, as published
};

/// The tuned fit: S0 nearly minimal; each cap starts as a sphere through the rim of the far face
/// of the box, half opening angle 30 degrees, and is re-centred in its plane.
SphereCenters tunedCenters(const PointLanes& in_frame, const PrincipalFrame& frame);

/// Method II as published: paper, III-B.2 and III-C.
SphereCenters publishedCenters(const PointLanes& in_frame, const PrincipalFrame& frame);

}  // namespace kios
