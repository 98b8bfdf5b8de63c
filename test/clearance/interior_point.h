// SPDX-FileCopyrightText: 2026 The fcl_kios authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <Eigen/Cholesky>
#include <Eigen/Core>
#include <cmath>
#include <vector>

#include "volume/exact_spheres.h"

namespace kios::testing {

using Real = long double;
using Real3 = Eigen::Matrix<Real, 3, 1>;
using Real33 = Eigen::Matrix<Real, 3, 3>;

/// Holds a volume's spheres exactly as stored, around its own S0.
struct StoredBalls {
  struct Sphere {
    Real3 c;
    Real r;
  };
  Real3 center0;
  std::vector<Sphere> spheres;

  template <typename S>
  explicit StoredBalls(const kIOS<S>& v) : center0(v.center0.template cast<Real>()) {
    for (int i = 0; i < v.k(); ++i) {
      const StoredSphere<Real> s(v, i);
      spheres.push_back({Real3(s.offset[0], s.offset[1], s.offset[2]), s.radius});
    }
  }
  /// Returns max |x - c| - r, x relative to S0's centre.
  Real outside(const Real3& x) const {
    Real worst = -1e300L;
    for (const Sphere& s : spheres) worst = std::max(worst, (x - s.c).norm() - s.r);
    return worst;
  }
};

/// Bounds of the distance of two volumes: `upper` is attained by feasible points x and y (relative
/// to a's S0, in frame A), `lower` is what the duality gap leaves.
struct Bracket {
  Real lower = 0, upper = 0;
  Real3 x, y;
};

/// Returns the log-barrier method in long double on min |x - (R w + d)|^2 subject to the spheres:
/// general convex optimisation, which knows nothing of circles, vertices or slabs. x and w start
/// inside.
inline Bracket interiorPointDistance(const StoredBalls& a, const StoredBalls& b, const Real33& R,
                                     const Real3& d, Real3 x, Real3 w) {
  using Real6 = Eigen::Matrix<Real, 6, 1>;
  using Real66 = Eigen::Matrix<Real, 6, 6>;
  Real size = d.norm();
  for (const StoredBalls* body : {&a, &b}) {
    for (const auto& s : body->spheres) size = std::max(size, s.c.norm() + s.r);
  }
  const auto barrier = [&](const Real3& at_x, const Real3& at_w, Real t) -> Real {
    Real value = t * (at_x - R * at_w - d).squaredNorm();
    for (const auto& s : a.spheres) {
      const Real slack = (s.r - (at_x - s.c).norm()) * (s.r + (at_x - s.c).norm());
      if (!(slack > 0)) return HUGE_VALL;
      value -= std::log(slack);
    }
    for (const auto& s : b.spheres) {
      const Real slack = (s.r - (at_w - s.c).norm()) * (s.r + (at_w - s.c).norm());
      if (!(slack > 0)) return HUGE_VALL;
      value -= std::log(slack);
    }
    return value;
  };
  const int constraints = static_cast<int>(a.spheres.size() + b.spheres.size());
  Bracket best;
  best.upper = HUGE_VALL;
  for (Real t = 1 / (size * size); t < 1e26L / (size * size); t *= 10) {
    bool central = false;
    for (int step = 0; step < 60; ++step) {
      Real6 g = Real6::Zero();
      Real66 H = Real66::Zero();
      const Real3 z = x - R * w - d;
      Eigen::Matrix<Real, 3, 6> J;
      J << Real33::Identity(), -R;
      g += 2 * t * J.transpose() * z;
      H += 2 * t * J.transpose() * J;
      const auto add = [&](const StoredBalls& body, const Real3& at, int row) {
        for (const auto& s : body.spheres) {
          const Real3 q = at - s.c;
          const Real slack = (s.r - q.norm()) * (s.r + q.norm());
          g.segment<3>(row) += 2 / slack * q;
          H.block<3, 3>(row, row) +=
              2 / slack * Real33::Identity() + 4 / (slack * slack) * q * q.transpose();
        }
      };
      add(a, x, 0);
      add(b, w, 3);
      const Real6 move = H.ldlt().solve(-g);
      const Real decrement = -g.dot(move);
      if (decrement < 1e-9L) {
        central = true;
        break;
      }
      const Real now = barrier(x, w, t);
      Real part = 1;
      while (part > 1e-12L && !(barrier(x + part * move.head<3>(), w + part * move.tail<3>(), t) <=
                                now - 0.1L * part * decrement)) {
        part /= 2;
      }
      if (!(part > 1e-12L)) break;
      x += part * move.head<3>();
      w += part * move.tail<3>();
    }
    const Real distance = (x - R * w - d).norm();
    if (distance < best.upper) {
      best.upper = distance;
      best.x = x;
      best.y = R * w + d;
    }
    if (!central) break;
    const Real square = distance * distance - 2 * constraints / t;  // twice: hardly off-centre
    if (square > 0) best.lower = std::max(best.lower, std::sqrt(square));
  }
  return best;
}

}  // namespace kios::testing
