// SPDX-FileCopyrightText: 2026 The fcl_kios authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <Eigen/Core>
#include <cstddef>
#include <cstdint>
#include <functional>
#include <limits>
#include <memory>
#include <string>
#include <vector>

#include <fcl/common/types.h>
#include <fcl/geometry/collision_geometry.h>
#include "fcl_kios/linkage.h"

// What a robot is asked for, and what it answers (robot.h).

namespace kios {

/// Numbers by coordinate, in memory of malloc() whatever a program's flags are. They convert to and
/// from Eigen::VectorXd, which the sanitizers' flags and Eigen's options make free it otherwise.
using UnalignedVector = Eigen::Matrix<double, Eigen::Dynamic, 1, Eigen::DontAlign>;

/// A collision element of a link, an attached object or an obstacle.
struct RobotElement {
  std::string name;  ///< whose it is
  int element = 0;   ///< which of its elements
  bool obstacle = false, attached = false;
  std::shared_ptr<const fcl::CollisionGeometryd> geometry;
  UnalignedPose X = UnalignedPose::Identity();  ///< in the frame that Robot::pose() gives
};

/// A planning group of the SRDF.
struct RobotGroup {
  std::string name;
  std::vector<std::string> joints;  ///< names of its coordinates, as Robot::joints()
  std::vector<int> coordinates;     ///< their places in q: q(coordinates) is the group's part
  std::vector<std::string> links;   ///< that its joints carry
  std::vector<std::string> end_effectors;  ///< groups that are its end effectors
};

/// Names two that are in contact: links, obstacles or attached objects. Where several pairs are, or
/// several triangles of a pair, it names one of them; which one may depend on what was asked
/// before.
struct RobotContact {
  std::string a, b;
  int element_a = 0, element_b = 0;  ///< which of a link's or object's collision elements
  /// Triangles of meshes that meet, cells of octrees; -1 for shapes.
  std::intptr_t id_a = -1, id_b = -1;
  /// A point of the contact in the world; halfway between the nearest points where paddings touch.
  fcl::Vector3d point = fcl::Vector3d::Zero();
};

/// Which of the pairs that are checked a clearance is of.
enum class RobotPairs {
  kAll,
  kItself,    ///< of links and attached objects
  kObstacles  ///< of these and obstacles
};

/// Options of Robot::clearance().
struct ClearanceRequest {
  RobotPairs among = RobotPairs::kAll;
  /// The distance may exceed the exact one by max(rel_err * exact, abs_err). >= 0.
  double rel_err = 0, abs_err = 0;
  /// The answer needs no more than a clearance of at least so much: the search stops there, and
  /// `clearance` is what it knows by then. Not NaN.
  double far_enough = std::numeric_limits<double>::infinity();
  bool gradient = true;  ///< d clearance / dq is asked for
};
using ClearanceOptions [[deprecated("now ClearanceRequest")]] = ClearanceRequest;

/// Distance of a pair less both paddings, with its gradient and nearest points.
struct RobotClearance {
  std::string a, b;                  ///< empty if there is no pair, or all are beyond far_enough
  int element_a = 0, element_b = 0;  ///< which of their collision elements
  double clearance = std::numeric_limits<double>::infinity();
  /// Proven but for the errors of docs/robot.md; of all pairs where the least was asked for.
  double lower_bound = std::numeric_limits<double>::infinity();
  /// Nearest points in the world, NaN without a pair; at contact a common one, if one is known.
  fcl::Vector3d point_a = fcl::Vector3d::Constant(std::numeric_limits<double>::quiet_NaN()),
                point_b = point_a;
  std::intptr_t id_a = -1, id_b = -1;  ///< their triangles, or cells of octrees; -1 for shapes
  /// Gradient by coordinate, n^T (J_b - J_a), n the direction from a to b, of length 1. Where the
  /// nearest pair of points is unique it is the derivative, else one of the generalised gradient.
  /// At contact n is that in which the penetration's depth shrinks: of two marked solids, the
  /// shortest way out that kios::penetration() finds, else the contact's normal. Empty if not asked
  /// for or without a pair.
  UnalignedVector gradient;
};

/// Options of Robot::checkMotion().
struct RobotMotionRequest : MotionRequest {
  RobotMotionRequest() = default;
  RobotMotionRequest(const MotionRequest& request) : MotionRequest(request) {}
  /// Refuses a path of which an end is beyond a joint's limits, by std::invalid_argument that names
  /// the joint. All between the ends is within them if both ends are.
  bool within_limits = false;
};

/// Answer for distances less the paddings, with the pair's names: those in contact, or undecided.
/// body_a and body_b are places in the order in which links, then attached objects and obstacles
/// have collision elements.
struct RobotMotion : MotionResult {
  std::string a, b;
};

/// Answer for distances less the paddings, with the pair's names; body_a and body_b as in
/// RobotMotion. In contact it is 0 less the paddings.
struct RobotRange : RangeResult {
  std::string a, b;
};

/// What is known of a pair of links.
enum class PairVerdict {
  /// Joined by a joint, or in contact in every configuration that was looked at: all there are of
  /// links that are fixed to each other, else 3,000 at random.
  kAlways,
  kNever,      ///< proven: in contact in no configuration within the limits
  kSometimes,  ///< in contact in the configuration q
  kOpen        ///< not settled within the budget
};

/// Options of Robot::linkPairs().
struct PairRequest {
  /// Bounds the boxes of configurations a pair that may be looked at, as RangeRequest::max_queries.
  long long max_boxes = 4000000;
  /// Seconds after which no more boxes are looked at; what is open then stays so. >= 0, may be
  /// infinite, upon which verdicts are the same on every machine.
  double max_seconds = 10;
  int threads = 0;  ///< 0: one a core
  /// Called by one thread at a time with how many of all pairs are settled.
  std::function<void(std::size_t settled, std::size_t all)> progress;
};
using PairOptions [[deprecated("now PairRequest")]] = PairRequest;

/// Says what two links can do within the limits of the joints between them.
struct LinkPair {
  std::string a, b;
  PairVerdict verdict = PairVerdict::kOpen;
  bool adjacent = false;  ///< a joint joins them
  UnalignedVector q;      ///< in contact there; empty for kNever, kOpen and `adjacent`
  long long boxes = 0;    ///< that were looked at; none where volumes are proof
  double seconds = 0;
};

/// Writes an SRDF of the robot of that name that disables the pairs kAlways and kNever.
std::string toSrdf(const std::vector<LinkPair>& pairs, const std::string& robot);

}  // namespace kios
