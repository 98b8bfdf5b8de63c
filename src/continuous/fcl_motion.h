// SPDX-FileCopyrightText: 2026 The fcl_kios authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <fcl/narrowphase/continuous_collision_request.h>
#include "continuous/motion.h"
#include "fcl_kios/fcl_own.h"

namespace kios::continuous {

/// Returns the motion that an FCL motion describes by its pose after integrate(t). The object is
/// only read, so that many threads may share it. Throws std::invalid_argument, naming the type, if
/// it isn't one of FCL's four (a derived class may integrate otherwise), null, or not finite.
Motion motionOf(const fcl::MotionBase<double>* motion);

/// Returns the motion from pose to pose that a request asks for.
Motion motionBetween(const fcl::Transform3d& X_0, const fcl::Transform3d& X_1,
                     fcl::CCDMotionType type);

}  // namespace kios::continuous
