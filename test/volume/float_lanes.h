// SPDX-FileCopyrightText: 2026 The fcl_kios authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <fcl/common/types.h>

#include "scenes/triangle_families.h"

namespace kios::testing {

/// Scales at which what is told in floats must hold, beyond what floats hold too.
constexpr double kFloatScales[] = {1e-30, 1e-18, 1e-3, 1, 1e6, 1e15, 1e30, 1e200};
/// Rounding alone makes a pair near: so much of its coordinates and of the distance.
constexpr double kVain = 1e-5;

inline fcl::Vector3d pointWithin(scenes::Random& random, double far) {
  return {random.uniform(-far, far), random.uniform(-far, far), random.uniform(-far, far)};
}

}  // namespace kios::testing
