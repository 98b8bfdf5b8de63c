// SPDX-FileCopyrightText: 2026 The fcl_kios authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "build/principal_frame.h"

namespace kios {

/// The frame of the smallest enclosing ellipsoid: middle, axes and half extents are its centre,
/// axes and semi-axes (paper, III-B.1). `in_frame` holds `points` in the frame `principal`, on
/// return in the new one.
PrincipalFrame ellipsoidFrame(const PointLanes& points, PointLanes& in_frame,
                              const PrincipalFrame& principal);

}  // namespace kios
