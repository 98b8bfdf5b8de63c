// SPDX-FileCopyrightText: 2026 The fcl_kios authors
// SPDX-License-Identifier: BSD-3-Clause
#include "paper/recenter.h"

#include <algorithm>

#include "volume/rounding.h"

namespace kios {
namespace {

/// A constraint |c - p|^2 + w <= value in the plane of a cap.
struct Weighted {
  double u, v, w;
  int index;
};

/// At most three constraints and the centre whose largest value over them is least (the optimum).
class CoreSet {
 public:
  double u = 0, v = 0, optimum = -1;
  Weighted support[3] = {};
  int size = 0;

  /// Adds a constraint; returns false if the centre satisfies it already.
  bool add(const Weighted& n) {
    if (value(n, u, v) <= optimum) return false;
    // n is active at the new optimum, alone, with one or with two others. The optimum of a subset
    // that is feasible for all is the optimum of all, so the first feasible centre will do.
    if (accept(n, n.u, n.v, -1, -1)) return true;
    for (int i = 0; i < size; ++i) {
      const Weighted& p = support[i];
      const double du = n.u - p.u, dv = n.v - p.v, length2 = du * du + dv * dv;
      if (!(length2 > 0)) continue;
      const double s = 0.5 * (length2 + n.w - p.w) / length2;
      if (s >= 0 && s <= 1 && accept(n, p.u + s * du, p.v + s * dv, i, -1)) return true;
    }
    for (int i = 0; i < size; ++i) {
      for (int j = i + 1; j < size; ++j) {
        const Weighted &p = support[i], &q = support[j];
        const double du = n.u - p.u, dv = n.v - p.v, eu = n.u - q.u, ev = n.v - q.v;
        const double det = du * ev - dv * eu;
        if (det == 0) continue;
        const double scale = -0.5 / det;
        // Equal values at n, p and q, in coordinates relative to n.
        const double cp = du * du + dv * dv + p.w - n.w, cq = eu * eu + ev * ev + q.w - n.w;
        if (accept(n, n.u + scale * (cp * ev - cq * dv), n.v + scale * (cq * du - cp * eu), i, j)) {
          return true;
        }
      }
    }
    return false;  // singular: no progress to be made with n
  }

 private:
  static double value(const Weighted& p, double u, double v) {
    return (p.u - u) * (p.u - u) + (p.v - v) * (p.v - v) + p.w;
  }

  /// Takes (cu, cv) and the support n, i, j if no other constraint exceeds n's value there.
  bool accept(const Weighted& n, double cu, double cv, int i, int j) {
    const double reached = value(n, cu, cv), limit = reached * (1 + 1e-9);
    if (!(reached < kInfinity)) return false;
    for (int o = 0; o < size; ++o) {
      if (o != i && o != j && value(support[o], cu, cv) > limit) return false;
    }
    u = cu;
    v = cv;
    optimum = reached;
    const Weighted kept[2] = {support[std::max(i, 0)], support[std::max(j, 0)]};
    size = 0;
    if (i >= 0) support[size++] = kept[0];
    if (j >= 0) support[size++] = kept[1];
    support[size++] = n;
    return true;
  }
};

}  // namespace

double farthestSquare(const Eigen::Matrix3Xd& points, const Eigen::Vector3d& center, int* index) {
  Eigen::Index at = 0;
  const double square = (points.colwise() - center).colwise().squaredNorm().maxCoeff(&at);
  if (index) *index = static_cast<int>(at);
  return square;
}

void recenterInPlane(const Eigen::Matrix3Xd& points, int height_axis, Eigen::Vector3d& center,
                     Support& support) {
  constexpr int kRounds = 6;
  constexpr double kGap = 1e-2;
  const int iu = (height_axis + 1) % 3, iv = (height_axis + 2) % 3;
  const double height = center[height_axis];
  const auto constraint = [&](int i) {
    const double h = points(height_axis, i) - height;
    return Weighted{points(iu, i), points(iv, i), h * h, i};
  };

  CoreSet core;
  for (int i = 0; i < support.size; ++i) core.add(constraint(support.index[i]));
  Eigen::Vector3d c = center;
  double best = kInfinity;
  for (int round = 0; round < kRounds; ++round) {
    if (core.size > 0) {
      c[iu] = core.u;
      c[iv] = core.v;
    }
    int far = 0;
    const double square = farthestSquare(points, c, &far);
    if (square < best) {
      best = square;
      center = c;
    }
    if (best <= core.optimum * (1 + kGap) || !core.add(constraint(far))) break;
  }
  support.size = core.size;
  for (int i = 0; i < core.size; ++i) support.index[i] = core.support[i].index;
}

}  // namespace kios
