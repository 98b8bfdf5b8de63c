// SPDX-FileCopyrightText: 2026 The fcl_kios authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "build/point_lanes.h"

namespace kios {

/// Points that hold a ball in place; a good first guess for a ball nearby.
struct Support {
  int index[3];
  int size = 0;
};

/// Moves the two coordinates of `center` other than `height_axis` to where the farthest point is
/// nearest, to 1 %: a minimal ball with additive weights, solved on a core set of at most four
/// points, first those of `support` (in and out). Any centre is safe: radii are measured later.
void recenterInPlane(const PointLanes& points, int height_axis, float center[3], Support& support);

}  // namespace kios
