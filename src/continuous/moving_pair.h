// SPDX-FileCopyrightText: 2026 The fcl_kios authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <memory>

#include "continuous/step_search.h"

namespace kios::continuous {

/// Two moving geometries, of which one at least is a mesh; all are referred to. Throws
/// std::invalid_argument if a model is not finished, or the pair is not served.
std::unique_ptr<StepSearch> movingPair(const fcl::CollisionGeometryd& a, const Motion& motion_a,
                                       const fcl::CollisionGeometryd& b, const Motion& motion_b,
                                       ContinuousCounts& counts);

}  // namespace kios::continuous
