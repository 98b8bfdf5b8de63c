// SPDX-FileCopyrightText: 2026 The fcl_kios authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "fit/point_lanes.h"

namespace kios {

/// Centre of a nearly minimal ball of the points: steps of decreasing size towards the farthest
/// point (Badoiu & Clarkson), the best centre seen. In and out: x, y, z.
void shrinkBall(const PointLanes& points, float center[3]);

/// Moves the two coordinates of `center` other than `height_axis` to where the farthest point is
/// nearest, to 0.1 %: a minimal ball with additive weights, solved on a core set of at most four
/// points. Any centre is safe, since radii are measured afterwards.
void recenterInPlane(const PointLanes& points, int height_axis, float center[3]);

}  // namespace kios
