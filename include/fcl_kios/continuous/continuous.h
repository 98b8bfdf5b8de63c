// SPDX-FileCopyrightText: 2026 The fcl_kios authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <fcl/geometry/collision_geometry.h>
#include <fcl/math/motion/motion_base.h>
#include <fcl/narrowphase/continuous_collision_request.h>
#include <fcl/narrowphase/continuous_collision_result.h>

namespace kios {

/// Counts the work done by a continuous query.
struct ContinuousCounts {
  long long steps = 0;            ///< times at which a free interval was proven
  long long volume_tests = 0;     ///< pairs of volumes tested
  long long leaf_tests = 0;       ///< pairs of triangles, or of a triangle and a shape, tested
  long long collision_tests = 0;  ///< exact collision queries at a single time
};

/// Finds the first contact of two moving objects at times in [0, 1], as fcl::continuousCollide
/// does. FCL's four motions are served (docs/continuous.md). Served: two kIOS models; a kIOS model
/// and one of FCL's nine shapes or an octree, in either order. Motions, models and their poses are
/// only read.
///
/// `result.is_collide == false` proves that they never touch. If it is true, time_of_contact is at
/// most the time of the first contact, which lies at most request.toc_err later. A pair that comes
/// so near without touching that no interval of toc_err / 2^20 can be proven free (or after 20000
/// steps below 2^-13, or 2^21 tests in them) counts as contact too. contact_tf1 and contact_tf2 are
/// the poses at time_of_contact, 1 if there is no contact, which is also what is returned.
///
/// Only toc_err and ccd_motion_type of the request count: all solver types get this answer, which
/// is what each of them promises, and num_max_iterations would make answers unsound. toc_err = 0 is
/// as fine as doubles allow.
///
/// Throws std::invalid_argument if a model is not a finished mesh, the pair is not served, a pose
/// not rigid, a motion of another type or not finite, or toc_err NaN or negative. `counts`, if
/// given, is added to.
double firstContact(const fcl::CollisionGeometryd& a, const fcl::MotionBased* motion_a,
                    const fcl::CollisionGeometryd& b, const fcl::MotionBased* motion_b,
                    const fcl::ContinuousCollisionRequestd& request,
                    fcl::ContinuousCollisionResultd& result, ContinuousCounts* counts = nullptr);
/// Moves the objects from pose to pose, by the motion that request.ccd_motion_type names.
double firstContact(const fcl::CollisionGeometryd& a, const fcl::Transform3d& X_WA_begin,
                    const fcl::Transform3d& X_WA_end, const fcl::CollisionGeometryd& b,
                    const fcl::Transform3d& X_WB_begin, const fcl::Transform3d& X_WB_end,
                    const fcl::ContinuousCollisionRequestd& request,
                    fcl::ContinuousCollisionResultd& result, ContinuousCounts* counts = nullptr);

}  // namespace kios
