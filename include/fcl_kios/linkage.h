// SPDX-FileCopyrightText: 2026 The fcl_kios authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <Eigen/Core>
#include <memory>
#include <vector>

#include <fcl/common/types.h>
#include <fcl/geometry/collision_geometry.h>
#include "fcl_kios/detail/rigid.h"
#include "fcl_kios/motion.h"

// A robot's motion between two configurations: is the straight path in joint space free of contact?
// The answer is proven, not sampled (docs/motions.md).

namespace kios {

/// Says how a joint moves its link.
enum class JointType { kFixed, kRevolute, kPrismatic };

/// Describes the joint that carries a link.
struct Joint {
  JointType type = JointType::kFixed;
  /// Places the joint in its parent link's frame: the link's frame where the coordinate is 0.
  /// Rigid; a rotation that is off by more than rounding is replaced by its nearest quaternion's.
  UnalignedPose X_PJ = UnalignedPose::Identity();
  /// Axis in the joint's frame: its direction is the joint's axis, and its length, which isn't 0,
  /// says how many radians, or of the models' units of length, a unit of the coordinate means.
  /// Fixed joints don't read it.
  fcl::Vector3d axis = fcl::Vector3d::UnitZ();
  /// Coordinate of q that moves it; -1: the next one that no joint has. Joints may share one: the
  /// joint stands at multiplier * q[coordinate] + offset, which is how one mimics another. Below
  /// 2^20, and what it stands at is finite for every q that is asked about.
  int coordinate = -1;
  double multiplier = 1, offset = 0;
};

/// Links on a tree of joints, and obstacles in the world. X_W,link = X_W,parent X_PJ J(v), J a
/// rotation about the axis or a translation along it, v = multiplier * q_k + offset. Const calls
/// are safe from many threads, and the geometry of its bodies must stay as it was. It may be
/// copied; copies share the geometry, and may be changed on their own.
class Linkage {
 public:
  Linkage();
  ~Linkage();
  Linkage(const Linkage& other);
  Linkage(Linkage&& other) noexcept;
  Linkage& operator=(Linkage other) noexcept;

  /// Adds a link that `joint` carries on the link `parent`, -1 for the world, and returns its
  /// number: 0, 1, ... Throws std::invalid_argument if there is no such parent, the pose is not
  /// rigid, or a moving joint's axis is not finite or of length 0, its coordinate not in [-1, 2^20)
  /// or its multiplier or offset not finite; nothing is changed then.
  int addLink(int parent, const Joint& joint);

  /// Adds a body to a link, at X_LB in its frame, and returns the body's number. The link -1 is for
  /// an obstacle that stands in the world. Numbers are 0, 1, ...; one that a removed body had is
  /// given again. Served are finished meshes over k-IOS, FCL's nine shapes and octrees. Half-spaces
  /// and planes must not turn: no revolute joint may carry them. Throws std::invalid_argument if
  /// there is no such link, the geometry is null, not served or unusable, or the pose is not rigid;
  /// nothing is changed then.
  int addBody(int link, std::shared_ptr<const fcl::CollisionGeometryd> geometry,
              const fcl::Transform3d& X_LB = fcl::Transform3d::Identity());
  /// Adds a body of another linkage. Its geometry isn't measured again: it is as it was there.
  int addBody(int link, const Linkage& of, int body,
              const fcl::Transform3d& X_LB = fcl::Transform3d::Identity());
  /// Moves a body on its link, or an obstacle in the world; or to another link, -1 for the world.
  /// It keeps its number and what is ignored. Takes microseconds, whatever else there is. Throws
  /// std::invalid_argument if there is no such body, or as addBody(); nothing is changed then.
  void moveBody(int body, const fcl::Transform3d& X_LB);
  void moveBody(int body, int link, const fcl::Transform3d& X_LB);
  /// Removes a body, with the pairs that are ignored of it. Throws std::invalid_argument if there
  /// is none.
  void removeBody(int body);

  /// Takes the pair out: it is never checked, unless it is taken in again. Bodies of one link never
  /// are, nor are two obstacles. Throws std::invalid_argument if there are no such bodies, or they
  /// are one.
  void ignorePair(int body_a, int body_b, bool ignored = true);
  [[deprecated("now ignorePair()")]] void allow(int body_a, int body_b) {
    ignorePair(body_a, body_b);
  }

  int coordinates() const;  ///< the size of q: one more than the largest that a joint has
  int links() const;
  int bodies() const;  ///< above all numbers of bodies that were ever there

  /// Returns the pose of a body in the world. Throws std::invalid_argument if there is no such
  /// body, or q is not of size coordinates() or not finite.
  fcl::Transform3d pose(int body, const Eigen::VectorXd& q) const;
  /// Returns the pose of a link in the world: its frame is its joint's, moved. Throws as pose().
  fcl::Transform3d linkPose(int link, const Eigen::VectorXd& q) const;

  class Impl;  // hidden
  const Impl& impl() const { return *impl_; }

 private:
  std::unique_ptr<Impl> impl_;
};

/// What is known of a path.
enum class MotionVerdict {
  kClear,       ///< proven: no pair of bodies is in contact anywhere on the path
  kContact,     ///< a configuration in contact was found
  kUnresolved,  ///< an interval as short as the resolution could be proven neither
  kBudgetSpent  ///< max_queries were made before any of these
};

/// Options of checkMotion().
struct MotionRequest {
  /// Counts a pair that is at most so far apart as in contact: clear means farther apart than this,
  /// all along. In the models' units, >= 0.
  double min_separation = 0;
  /// Shortest interval of the path's parameter that is looked at, in [2^-40, 1]: where an interval
  /// this short can't be proven clear and shows no contact, the answer is kUnresolved.
  double resolution = 0x1p-20;
  /// If true, the earliest contact is asked for, else any, which takes less time.
  bool first_contact = false;
  /// Bounds the time that a call takes: MotionCounts::queries doesn't exceed it by more than the
  /// pairs that are near at the path's end, start and middle. Most paths take fewer than a
  /// thousand. >= 0.
  long long max_queries = 1000000;
};

/// Counts the work done by checkMotion.
struct MotionCounts {
  long long configurations = 0;  ///< for which the poses of all bodies were computed
  long long pairs = 0;           ///< of bodies that may be checked
  long long proven_at_once = 0;  ///< of these, by bounding volumes at one configuration
  /// Counts questions about a pair at a configuration, by volumes, slabs or the narrow phase. A
  /// search for slabs between triangles counts as many as take as long.
  long long queries = 0;
  long long narrow_queries =
      0;  ///< of these: a pair at a configuration: farther apart than it may move?
  long long expansions = 0;  ///< nodes of prepared trees whose children these tested
};

/// Answer of checkMotion(), with the interval and the pair that it is about.
struct MotionResult {
  MotionVerdict verdict = MotionVerdict::kClear;
  /// An interval of the path's parameter. kClear: [0, 1], which is proven. kContact: a
  /// configuration in contact lies in [from, to], and to - from <= resolution; `to` is one. With
  /// first_contact all before `from` is proven clear. kUnresolved: the interval that could not be
  /// decided. kBudgetSpent: an interval that is not decided yet; with first_contact all before
  /// `from` is proven clear.
  double from = 0, to = 1;
  int body_a = -1, body_b = -1;  ///< the pair in contact, or undecided; body_a < body_b
  MotionCounts counts;
};
using MotionAnswer [[deprecated("now MotionResult")]] = MotionResult;

/// Decides whether the path q0 + s (q1 - q0), 0 <= s <= 1, is clear of contact. kClear is a proof
/// for every real s and exact kinematics, with the rounding of poses, angles and bounds paid for.
/// kContact means that the static query (fcl::collide, or fcl::distance <= min_separation) confirms
/// a contact of the bodies at their pose() in the configuration `to`, computed as q0 + to * (q1 -
/// q0), and q1 at 1. Two shapes are posed as FCL poses them: a contact is what FCL's GJK says it
/// is, while kClear is proven by a separating slab. Pairs of which one is not occupied are never in
/// contact.
///
/// Where q0 = q1 this asks about one configuration: kContact names the two bodies.
///
/// Throws std::invalid_argument if q0 or q1 is not of size coordinates() or not finite, an option
/// is out of range, a body's mesh was changed since it was added, or a pair that moves can't be
/// served: an octree against anything but a mesh, or half-spaces and planes against each other.
MotionResult checkMotion(const Linkage& linkage, const Eigen::VectorXd& q0,
                         const Eigen::VectorXd& q1, const MotionRequest& request = {});

/// Ranges of all coordinates of a linkage, each from lower to upper. A coordinate that only turns
/// links, all by the same angle, is looked at over one full turn if its range is wider, or
/// infinite.
struct JointBox {
  std::vector<double> lower, upper;
};

/// Brackets the least clearance of a linkage's pairs on a straight path, or in a box of
/// coordinates. The path is q0 + s (q1 - q0), 0 <= s <= 1. By proofs for thresholds, or branch and
/// bound; boxes in which six or seven coordinates have wide ranges end incomplete. Safe from many
/// threads, and repeatable.
///
/// Throws std::invalid_argument as checkMotion() for configurations and geometry, if an option is
/// out of range, or a range has a lower end above the upper one, or no end where it doesn't only
/// turn links.
RangeResult leastClearance(const Linkage& linkage, const Eigen::VectorXd& q0,
                           const Eigen::VectorXd& q1, const RangeRequest& request = {});
RangeResult leastClearance(const Linkage& linkage, const JointBox& box,
                           const RangeRequest& request = {});
/// Finds the same of each pair that is checked, by body_a and body_b ascending. max_queries bounds
/// each. Of a pair that can't be served nothing is known: its bracket is all, and not complete.
/// Throws as leastClearance() for all else.
std::vector<RangeResult> leastClearances(const Linkage& linkage, const Eigen::VectorXd& q0,
                                         const Eigen::VectorXd& q1,
                                         const RangeRequest& request = {});
std::vector<RangeResult> leastClearances(const Linkage& linkage, const JointBox& box,
                                         const RangeRequest& request = {});

}  // namespace kios
