// SPDX-FileCopyrightText: 2026 The fcl_kios authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstddef>

#include "build/point_lanes.h"
#include "volume/lanes.h"

namespace kios {

/// Four points.
struct PointQuad {
  lanes::Float4 x, y, z;
};

/// The places of a volume's spheres: S0 in the frame of the points, k - 1 caps relative to it.
struct SphereSites {
  int k = 1;
  float center[3] = {};
  lanes::Float4 cap[3] = {};  ///< by coordinate: a cap a lane
};

/// The tuned fit. `points` lie relative to the first of them, which is at `first`.
SphereSites placeTuned(const PointLanes& points, const float first[3], PointLanes& scratch);

/// The largest squared distances of points from S0's centre, and from the four caps'.
struct FarthestSquares {
  float s0;
  lanes::Float4 cap;
};
FarthestSquares farthestSquares(const PointQuad* quads, std::size_t n, const SphereSites& sites);

}  // namespace kios
