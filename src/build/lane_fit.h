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

/// The points of a set that lie farthest along the axes and the diagonals of a cube, each once.
/// They stand for a large set where spheres are placed, never where radii are measured.
struct Extremes {
  static constexpr int kDirections = 13;  ///< half of the 26
  static constexpr int kMost = 2 * kDirections;
  int count = 0;
  float x[kMost], y[kMost], z[kMost];

  void move(lanes::Float4 by);
};

Extremes extremesOf(const PointQuad* quads, std::size_t n);

}  // namespace kios
