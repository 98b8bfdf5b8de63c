// SPDX-FileCopyrightText: 2026 The fcl_kios authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "volume/lanes.h"

namespace kios {

/// Four small sets of points, one a lane. A set with fewer points than `count` repeats one of its
/// own, with weight 0.
struct FourSets {
  static constexpr int kMost = 32;
  int count = 0;
  lanes::Float4 x[kMost], y[kMost], z[kMost];
  lanes::Float4 weight[kMost];  ///< 0 or 1
};

/// The places of the spheres of four volumes: S0 in the frame of the points, caps relative to it.
struct FourSites {
  int k[4];
  lanes::Float4 center[3];
  lanes::Float4 cap[4][3];
};

/// A fit of a few points, about as tight as the tuned one: each sphere is centred in its plane
/// along one axis after the other. `thorough` takes half as long again, for what is tested often.
FourSites placeFour(const FourSets& sets, bool thorough);

/// The tuned fit of triangles in closed form: sets of three points.
FourSites placeFourTriangles(const FourSets& triangles);

/// The largest squared distances of the points from S0's centre, and from the caps'.
struct FourSquares {
  lanes::Float4 s0, cap[4];
};
FourSquares farthestSquares(const FourSets& sets, const FourSites& sites);

}  // namespace kios
