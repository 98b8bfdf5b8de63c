// SPDX-FileCopyrightText: 2026 The fcl_kios authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "linkage/body_queries.h"

namespace kios::articulated {

/// How long a slab between two bodies lasts. It is across the pair's direction n, between a plane
/// that bounds a from above and one that bounds b from below, in the link that carries both.
///
/// A point x of a, at a depth D(x) >= 0 below its plane, comes nearer to it by at most
///   t n . x' + t^2 / 2 n . x'' + |t|^3 / 6 (jerk + |t| growth)
/// within t of s; lengths are the linkage's, times those of s, primes derivatives by s, and b is
/// like a along -n. The body is rigid: with r the vector to x from its own origin o, and
/// w_i the rate of joint i times its axis through o_i, j the joints after i,
///   n . x'  = n . o'  + (n x W) . r,                                   W = sum w_i
///   n . x'' = n . o'' + sum_i ((n x w_i) x (w_i + 2 sum_j w_j)) . r,
///   n . o'' = sum_i (n x w_i) . (w_i x (o - o_i) + 2 v_i),             v_i = o' by the joints j
/// as joint i turns the velocities by the later ones, twice, and its own. So what the motion takes
/// of the slab,
///   max_x p n . x' + q n . x'' - D(x),
/// is a support of the body's hull, and convex in (p, q). Up to a time T, (t, t^2 / 2) lies in the
/// triangle of (0, 0), (T / 2, 0) and (T, T^2 / 2), and one of its corners takes the most. The far
/// end of a link is fast but lies deep, and what turns about its own axis takes hardly anything.
///
/// The third derivative by joints i <= k <= m is a product of their axes with the arm of the last;
/// with S_m the sum of |w_i| up to m it is at most
///   sum_m rho_m (S_m^3 - S_(m-1)^3),
/// and 3 S_(m-1)^2 |w_m| for a slide; rho_m, the distance from the axis, grows as Path says.
class SlabMotion {
 public:
  /// At c. With `planes` the slab is between the supports of both bodies, as BodyQueries::slab()
  /// finds it; else somewhere between the bodies, and D is taken to be 0.
  SlabMotion(const Configuration& c, const Pair& pair, bool planes);

  /// Returns a time of at most `longest` <= 1 in which a slab as wide as `gap` isn't used up, as s
  /// grows (sign 1) or falls (-1); 0 if none is found.
  double timeFor(double gap, double sign, double longest) const;

 private:
  /// A body that moves. Vectors are in its own frame: of r in -D, n . x' and n . x''.
  struct Side {
    const SupportTable* supports;
    Eigen::Vector3d depth, first, second;
    double support, speed, change;  ///< at its origin
  };
  void add(const Configuration& c, int id, int shared, const Eigen::Vector3d& n, bool planes);
  /// What both bodies take at (p, q).
  double used(double p, double q) const;
  /// What they take up to a time, at its worst.
  double usedUpTo(double time, double sign) const;

  Side sides_[2];
  int count_ = 0;
  double turns_ = 0, jerk_ = 0, growth_ = 0, rounding_ = 0, pad_;
};

}  // namespace kios::articulated
