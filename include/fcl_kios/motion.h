// SPDX-FileCopyrightText: 2026 The fcl_kios authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <limits>
#include <vector>

#include <fcl/common/types.h>
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

// How near do bodies come while they move? A bracket of the least distance, proven and not sampled
// (docs/range.md). Lengths are in the models' units.

/// Options of leastClearance(). The search ends once upper - lower <= max(abs_err, rel_err *
/// upper), or nothing comes nearer than the ceiling.
struct RangeRequest {
  double abs_err = 1e-4, rel_err = 0.01;  ///< finite and >= 0
  /// What is farther apart isn't looked at; not NaN. Nothing is nearer than 0, less the padding.
  double ceiling = std::numeric_limits<double>::infinity();
  /// Bounds the time that a call takes, as MotionRequest::max_queries: a query is a pair at a
  /// configuration, or the tests of moving volumes that take as long. >= 0.
  long long max_queries = 100000;
  /// Taken off every distance, for skins of the bodies that are no part of the models. Finite, >=
  /// 0.
  double padding = 0;
};

/// A bracket of the least clearance: of distances, less the padding.
struct RangeResult {
  /// Proven: nowhere in the range, for exact motions, is a pair nearer. Infinite if no pair is
  /// checked, and the ceiling, or 0 less the padding, if all are proven to stay beyond it.
  double lower = 0;
  /// The least that was seen, with its rounding: two points of a pair come so near. 0, less the
  /// padding, where the static query finds a contact, and `lower` is then the same; infinite if
  /// nothing was seen within the ceiling.
  double upper = std::numeric_limits<double>::infinity();
  /// Where `upper` was seen: a configuration of the linkage, or the motions' time; empty if
  /// nowhere.
  std::vector<double> at;
  /// The pair seen there, of a linkage, or that leastClearances() asked about; body_a < body_b.
  int body_a = -1, body_b = -1;
  /// Nearest points there in the world; at contact NaN.
  fcl::Vector3d point_a = fcl::Vector3d::Constant(std::numeric_limits<double>::quiet_NaN());
  fcl::Vector3d point_b = point_a;
  /// False if max_queries, or what rounding leaves to be proven, ended the search first. The
  /// bracket holds in any case.
  bool complete = false;
  long long queries = 0;  ///< made
};

/// Finds how near two objects come to each other while each follows its motion, t in [0, 1]. Served
/// are FCL's four motions, and pairs of which one is a mesh over k-IOS, the other one too, one of
/// FCL's nine shapes or an octree. Solids one in the other are in contact, what isn't occupied is
/// infinitely far away. `at` is the time. Throws std::invalid_argument if an option is out of
/// range, a model is not a finished mesh, the pair is not served, or a motion of another type or
/// not finite.
RangeResult leastClearance(const fcl::CollisionGeometryd& a, const fcl::MotionBased* motion_a,
                           const fcl::CollisionGeometryd& b, const fcl::MotionBased* motion_b,
                           const RangeRequest& request = {});

}  // namespace kios
