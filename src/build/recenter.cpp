// SPDX-FileCopyrightText: 2026 The fcl_kios authors
// SPDX-License-Identifier: BSD-3-Clause
#include "build/recenter.h"

#include <algorithm>
#include <cmath>

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

void recenterInPlane(const PointLanes& points, int height_axis, float center[3], Support& support) {
  constexpr int kRounds = 6;
  constexpr double kGap = 1e-2;
  const float* const coordinates[3] = {points.x(), points.y(), points.z()};
  const int iu = (height_axis + 1) % 3, iv = (height_axis + 2) % 3;
  const double height = center[height_axis];
  const auto constraint = [&](int i) {
    const double h = coordinates[height_axis][i] - height;
    return Weighted{coordinates[iu][i], coordinates[iv][i], h * h, i};
  };

  CoreSet core;
  for (int i = 0; i < support.size; ++i) core.add(constraint(support.index[i]));
  float c[3] = {center[0], center[1], center[2]};
  double best = kInfinity;
  for (int round = 0; round < kRounds; ++round) {
    if (core.size > 0) {
      c[iu] = static_cast<float>(core.u);
      c[iv] = static_cast<float>(core.v);
    }
    const auto far = points.farthest(c[0], c[1], c[2]);
    if (far.squared_distance < best) {
      best = far.squared_distance;
      std::copy_n(c, 3, center);
    }
    if (best <= core.optimum * (1 + kGap) || !core.add(constraint(far.index))) break;
  }
  support.size = core.size;
  for (int i = 0; i < core.size; ++i) support.index[i] = core.support[i].index;
}

}  // namespace kios
