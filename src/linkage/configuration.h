// SPDX-FileCopyrightText: 2026 The fcl_kios authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <algorithm>
#include <vector>

#include "linkage/link_tree.h"

namespace kios::articulated {

/// The path q(s) = q0 + s (q1 - q0) of a linkage, s in [0, 1], and the bounds that hold all along
/// it.
///
/// Let x(q) be a point of a body in the world, by exact kinematics with the stored rotations, and
/// T_i the motion of joint i of the n joints on the way to it. Between two configurations q, q'
///   |x(q') - x(q)| <= sum_i |T_1' .. T_(i-1)' (T_i' - T_i) T_(i+1) .. T_n x|
///                  <= sum_i |q_i' - q_i| unit_i rho_i(q),
/// rho_i(q) the distance of x(q) from the axis of joint i in the configuration q (1 if i is
/// prismatic): T_1' .. T_(i-1)' is rigid, and a turn by an angle moves a point by at most the angle
/// times its distance from the axis, which does not depend on the joints before i. All distances
/// are taken at the one configuration q. Seen from a link that carries both of two bodies, the
/// joints before that link drop out. This is `most` below.
///
/// Near q the velocity tells more, in which motions of joints cancel: x moves by h x'(q) and at
/// most h^2 / 2 times the largest acceleration on the way. With w_i the rate of joint i,
///   |x''| <= sum_i |w_i| rho_i (|w_i| + 2 sum_(j < i) |w_j|),
/// as each turn carries the velocities of the joints after it along (prismatic joints: |w_i| (2
/// sum)). There rho_i is that of the moment, at most rho_i(q) and h times what the joints after i
/// move by. `first`, `second` and `third` are the factors of h, h^2 / 2 and h^3 / 2.
///
/// Rounding, u = 2^-53. A level of joints takes two products of rotations, 9 u each (Frobenius),
/// and a rotation about an axis, 40 u: the axis is of length 1 and in its direction to 4 u, and an
/// entry takes 8 roundings. Translations take 12 u of the lengths of a level and 2 u of what they
/// add up to. With L the sum of the lengths of all offsets, of the prismatic joints' travel and of
/// the content's reach, a point of the body is off by at most 80 u (n + 2) L, n the level of its
/// link: the two more are the body's own pose. Rotations are orthonormal to 160 u (n + 2) (spectral
/// norm of E = R^T R - I), so that a distance d in the first body's frame is one of at least
/// d - 3 |E| (L + L') in the world, as no length in it exceeds L + L'. Both together are below
/// 640 u (n + n' + 4) (L + L'). `pad` is 1024 u in the place of 640, and pays for the bounds of
/// balls, boxes and supports too, which take fewer than 40 roundings of such lengths. Coordinates
/// as computed are those of q(s) to 5 u max(|q0|, |q1|), and the angle or length (m q + o) unit, m
/// and o a joint's multiplier and offset, is to 6 u (|m q| + |o|) unit more; 16 u
/// is `slack`, by which the path is as if it took a detour. Joints that share a coordinate are
/// bounded each by itself, w_i = m_i (q1 - q0) unit_i: every bound holds for any motions of the
/// joints that are straight in s.
class Path {
 public:
  /// Throws std::invalid_argument if a configuration isn't of the linkage's size or not finite.
  Path(const Linkage::Impl& linkage, const Eigen::VectorXd& q0, const Eigen::VectorXd& q1);

  const Linkage::Impl& linkage() const { return linkage_; }
  double coordinate(int k, double s) const {
    return s == 1 ? q1_[k] : q0_[k] + s * (q1_[k] - q0_[k]);
  }
  /// The way of a moving joint from q0 to q1, in radians or lengths, to 2^-51 of it.
  double rate(int link) const { return sweeps_[link].rate; }

  /// L of a body.
  double length(int body) const { return shares_[slot(body)].length + obstacleLength(body); }
  /// Bounds the rounding of a pair.
  double pad(int a, int b) const {
    const Share &x = shares_[slot(a)], &y = shares_[slot(b)];
    return 0x1p-43 * (x.level + y.level) * (length(a) + length(b)) + x.slack + y.slack;
  }
  /// >= the pad of a carried body with any obstacle.
  double padOfObstacles(int body) const {
    const Share& share = shares_[slot(body)];
    return 0x1p-43 * (share.level + 2) * (share.length + linkage_.obstacles.farthest()) +
           share.slack;
  }
  /// Returns a share: those of two carried bodies sum to at least their pad.
  double padShare(int body) const {
    const Share& share = shares_[slot(body)];
    return 0x1p-42 * largest_level_ * share.length + share.slack;
  }
  /// A bound of the rounding of the distance of a body's content from an axis.
  double axisRounding(int body) const { return 0x1p-43 * shares_[slot(body)].level * length(body); }
  /// >= the way of any point of a carried body in a unit of s, wherever on the path, seen from the
  /// link that the first `shared` joints carry: rho_i <= the lengths from joint i to the body's
  /// farthest point. Takes no configuration.
  double swept(int body, int shared) const;
  /// True if no joint moves the bodies of a pair, of which the first `shared` carry both, against
  /// each other: what is proven of them at one configuration holds all along.
  bool still(int a, int b, int shared) const {
    return movesAfter(a, shared) + movesAfter(b, shared) == 0;
  }
  bool moves() const { return moves_; }  ///< true if any joint does
  /// >= the square of the Frobenius norm of E = R^T R - I of a body's pose.
  double rotationSquare(int body) const {
    const double error = 0x1p-44 * shares_[slot(body)].level;
    return error * error;
  }

 private:
  struct Share {
    double length = 0, level = 2, slack = 0;  ///< the level is n + 2
  };
  /// A link: its joint's rate; and sums over the joints from the world to it, itself included: how
  /// far they slide, how they turn, and this times `length`, which is what lies before an axis: of
  /// offsets, and of travel. `travel` is what prismatic joints add to lengths, the last two are the
  /// rounding of angles and of lengths.
  struct Sweep {
    double rate = 0, slides = 0, turns = 0, arms = 0, length = 0;
    double travel = 0, angles = 0, shifts = 0;
    int moves = 0;  ///< how many of the joints do
  };
  int movesAfter(int body, int shared) const;
  std::size_t slot(int body) const {
    const int after_obstacles = linkage_.bodies[body].carried + 1;
    return static_cast<std::size_t>(after_obstacles);
  }
  double obstacleLength(int body) const { return linkage_.bodies[body].box.length; }

  const Linkage::Impl& linkage_;
  const Eigen::VectorXd &q0_, &q1_;
  std::vector<Share> shares_;  // of all obstacles, then by carried body
  std::vector<Sweep> sweeps_;  // by link
  double largest_level_ = 2;
  bool moves_ = false;
};

/// The motion of a body near a configuration, seen from the link that carries another body as well:
/// by the joints that carry only this one. Velocities are in the world's axes, times are those of
/// s.
struct BodyMotion {  // NOLINT(bugprone-reserved-identifier): in the copy of an array
  double most = 0;   ///< no point moves farther than this in a unit of s, from the configuration on
  /// Velocities of the ends of the capsule, and the angular one times its radius: no point of the
  /// capsule is faster than an end by more than |swing|, and `rounding`.
  Eigen::Vector3d ends[2] = {Eigen::Vector3d::Zero(), Eigen::Vector3d::Zero()};
  Eigen::Vector3d swing = Eigen::Vector3d::Zero();
  double rounding = 0;
  double change[2] = {0, 0};  ///< accelerations are at most change[0] + change[1] h, h away from s

  /// No point moves farther than this within `time` of the configuration.
  double during(double time) const;
};

/// The motion of two bodies relative to each other.
class PairMotion {
 public:
  PairMotion(const BodyMotion& a, const BodyMotion& b);

  /// Within `time` of the configuration no distance changes by more than this.
  double during(double time) const { return std::min(most_ * time, after(time)); }
  /// A time of at most `longest` in which no distance changes by more than `gap` > 0.
  double timeFor(double gap, double longest) const;

 private:
  double after(double time) const {
    return time * (first_ + 0.5 * time * (second_ + time * third_));
  }

  double most_, first_, second_, third_;
};

/// A joint that moves, in the world at a configuration.
struct MovingJoint {
  Eigen::Vector3d axis, origin;  ///< a point of the axis
  double rate;                   ///< Path::rate()
  bool turns;
};

/// The bodies at a configuration s of a path.
class Configuration {
 public:
  /// A link in the world, and the axis of its joint.
  struct PlacedLink {
    Eigen::Matrix3d R;
    Eigen::Vector3d t, axis;
  };

  Configuration(const Path& path, double s) { set(path, s); }
  /// Moves the bodies of the same path.
  void set(const Path& path, double s);

  double s() const { return s_; }
  const fcl::Transform3d& pose(int id) const {
    const BodyData& body = bodyAt(id);
    return body.carried < 0 ? body.X_LB : placed_[body.carried].X;
  }
  fcl::Transform3d linkPose(int link) const {
    fcl::Transform3d X = fcl::Transform3d::Identity();
    X.linear() = links_[link].R;
    X.translation() = links_[link].t;
    return X;
  }
  /// Centre of a body's ball in the world.
  const Eigen::Vector3d& center(int id) const {
    const BodyData& body = bodyAt(id);
    return body.carried < 0 ? body.content.center : placed_[body.carried].center;
  }
  /// >= n . x for every point x of a bounded body in the world; `point` as SupportTable::along().
  double support(int id, const Eigen::Vector3d& n, Eigen::Vector3d& point) const {
    const fcl::Transform3d& X = pose(id);
    const double along =
        path_->linkage().bodies[id].own->supports.along(X.linear().transpose() * n, &point);
    point = X * point;
    return n.dot(X.translation()) + along;
  }
  const Path& path() const { return *path_; }
  const PlacedLink& link(int link) const { return links_[link]; }
  /// The joints after the first `shared` that carry the body and don't stand still, the world's
  /// first.
  std::vector<MovingJoint> jointsOf(int id, int shared) const;
  /// By the joints after the first `shared` that carry the body.
  const BodyMotion& motion(int id, int shared) const {
    const BodyData& body = bodyAt(id);
    if (body.carried < 0) return motions_[0];
    if (!placed_[body.carried].moves) addMotions(body, id);
    return motions_[body.first_motion + shared];
  }

 private:
  struct PlacedBody {
    fcl::Transform3d X;
    Eigen::Vector3d center;
    bool ready = false, moves = false;  ///< the pose, and the motions, were asked for and are set
  };
  const BodyData& bodyAt(int id) const {
    const BodyData& body = path_->linkage().bodies[id];
    if (body.carried >= 0 && !placed_[body.carried].ready) place(body);
    return body;
  }
  void place(const BodyData& body) const;
  void addMotions(const BodyData& body, int id) const;

  const Path* path_ = nullptr;
  double s_ = 0;
  std::vector<PlacedLink> links_;
  mutable std::vector<PlacedBody> placed_;  // those that are carried
  mutable std::vector<BodyMotion> motions_;
};

}  // namespace kios::articulated
