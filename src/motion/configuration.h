// SPDX-FileCopyrightText: 2026 The fcl_kios authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <vector>

#include "motion/link_tree.h"

namespace kios::articulated {

/// The path q(s) = q0 + s (q1 - q0) of a linkage, s in [0, 1], and the bounds that hold all along it.
///
/// Let x(q) be a point of a body in the world, by exact kinematics with the stored rotations, and
/// T_i the motion of joint i of the n joints on the way to it. Between two configurations q, q'
///   |x(q') - x(q)| <= sum_i |T_1' .. T_(i-1)' (T_i' - T_i) T_(i+1) .. T_n x|
///                  <= sum_i |q_i' - q_i| unit_i rho_i(q),
/// rho_i(q) the distance of x(q) from the axis of joint i in the configuration q (1 if i is
/// prismatic): T_1' .. T_(i-1)' is rigid, and a turn by an angle moves a point by at most the angle
/// times its distance from the axis, which does not depend on the joints before i. All distances are
/// taken at the one configuration q. Seen from a link that carries both of two bodies, the joints
/// before that link drop out.
///
/// Rounding, u = 2^-53. A level of joints takes two products of rotations, 9 u each (Frobenius), and
/// a rotation about an axis, 40 u: the axis is of length 1 and in its direction to 4 u, and an entry
/// takes 8 roundings. Translations take 12 u of the lengths of a level and 2 u of what they add up
/// to. With L the sum of the lengths of all offsets, of the prismatic joints' travel and of the
/// content's reach, a point of the body is off by at most 80 u (n + 2) L, n the level of its link:
/// the two more are the body's own pose. Rotations are orthonormal to 160 u (n + 2) (spectral norm of
/// E = R^T R - I), so that a distance d in the first body's frame is one of at least d - 3 |E| (L +
/// L') in the world, as no length in it exceeds L + L'. Both together are below 640 u (n + n' + 4) (L
/// + L'); 1024 u is `pad`, and pays for the bounds of balls and boxes too, which take fewer than 40
/// roundings of such lengths. Coordinates as computed are those of q(s) to 5 u max(|q0|, |q1|), and
/// the angle or length is to 4 u more; 16 u is `slack`, by which the path is as if it took a detour.
class Path {
 public:
  /// Throws std::invalid_argument if a configuration isn't of the linkage's size or not finite.
  Path(const Linkage::Impl& linkage, const Eigen::VectorXd& q0, const Eigen::VectorXd& q1);

  const Linkage::Impl& linkage() const { return linkage_; }
  double coordinate(int k, double s) const {
    return s == 1 ? q1_[k] : q0_[k] + s * (q1_[k] - q0_[k]);
  }
  /// |q1 - q0| of a moving joint, in radians or lengths, rounded up.
  double change(int link) const { return changes_[linkage_.links[link].coordinate]; }

  /// L of a body, with the rounding that is its own share of a pair's.
  double length(int body) const { return lengths_[body]; }
  /// The part of the pad and of the detour that a body pays in every pair: the pair's is (n + n' + 4)
  /// (L + L') times 1024 u, and both slacks.
  double pad(int a, int b) const {
    return 0x1p-43 * (levels_[a] + levels_[b]) * (lengths_[a] + lengths_[b]) + slacks_[a] +
           slacks_[b];
  }
  /// A bound of the rounding of the distance of a body's content from an axis.
  double axisRounding(int body) const { return 0x1p-43 * levels_[body] * lengths_[body]; }
  /// >= the square of the Frobenius norm of E = R^T R - I of a body's pose.
  double rotationSquare(int body) const {
    const double error = 0x1p-44 * levels_[body];
    return error * error;
  }

 private:
  const Linkage::Impl& linkage_;
  const Eigen::VectorXd &q0_, &q1_;
  std::vector<double> changes_;                   // by coordinate
  std::vector<double> lengths_, levels_, slacks_;  // by body; levels are n + 2
};

/// All bodies at a configuration s of a path.
class Configuration {
 public:
  Configuration(const Path& path, double s) { set(path, s); }
  /// Moves the bodies of the same path.
  void set(const Path& path, double s);

  double s() const { return s_; }
  const fcl::Transform3d& pose(int body) const { return poses_[body]; }
  /// Centre of a body's ball in the world.
  const Eigen::Vector3d& center(int body) const { return centers_[body]; }
  /// Bound of the way of any point of the body in a unit of s, by the joints after the first `shared`
  /// that carry it; the same for all s.
  double speed(int body, int shared) const { return speeds_[first_speed_[body] + shared]; }

 private:
  void setSpeeds(const Path& path, int body);

  double s_ = 0;
  std::vector<Eigen::Matrix3d> R_;  // by link
  std::vector<Eigen::Vector3d> t_, axes_;
  std::vector<fcl::Transform3d> poses_;
  std::vector<Eigen::Vector3d> centers_;
  std::vector<int> first_speed_;
  std::vector<double> speeds_;
};

}  // namespace kios::articulated
