// SPDX-FileCopyrightText: 2026 The fcl_kios authors
// SPDX-License-Identifier: BSD-3-Clause
#include "fit/enclosing.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace kios {
namespace {

/// A constraint |c - p|^2 + w <= value in the plane of a cap.
struct Weighted {
  double u, v, w;
};

double value(const Weighted& p, double u, double v) {
  return (p.u - u) * (p.u - u) + (p.v - v) * (p.v - v) + p.w;
}

/// At most three supporting constraints, and the newest one behind them.
struct CoreSet {
  Weighted points[4];
  int size = 0;
  double u = 0, v = 0, optimum = 0;

  bool satisfiedAt(double cu, double cv, double limit) const {
    const double tolerance = limit * (1 + 1e-9);
    for (int i = 0; i < size; ++i) {
      if (value(points[i], cu, cv) > tolerance) return false;
    }
    return true;
  }

  /// Solves min max over the set, the newest point (the last) being in the support; keeps the
  /// support only. The least valid candidate of the subsets of size 1 to 3 is the optimum.
  void solve() {
    const Weighted n = points[size - 1];
    double best = std::numeric_limits<double>::infinity();
    int support[2] = {-1, -1}, supports = 0;
    const auto consider = [&](double cu, double cv, int count, int i, int j) {
      const double candidate = value(n, cu, cv);
      if (candidate < best && satisfiedAt(cu, cv, candidate)) {
        best = candidate;
        u = cu;
        v = cv;
        supports = count;
        support[0] = i;
        support[1] = j;
      }
    };
    consider(n.u, n.v, 0, -1, -1);
    for (int i = 0; i < size - 1; ++i) {
      const Weighted& p = points[i];
      const double du = n.u - p.u, dv = n.v - p.v, length2 = du * du + dv * dv;
      const double s = (length2 + n.w - p.w) / (2 * length2);
      if (s >= 0 && s <= 1) consider(p.u + s * du, p.v + s * dv, 1, i, -1);
      for (int j = i + 1; j < size - 1; ++j) {
        const Weighted& q = points[j];
        const double eu = n.u - q.u, ev = n.v - q.v;
        const double det = 4 * (du * ev - dv * eu);
        if (det == 0) continue;
        // Equal values at n, p and q, in coordinates relative to n.
        const double cp = length2 + p.w - n.w, cq = eu * eu + ev * ev + q.w - n.w;
        consider(n.u - 2 * (cp * ev - cq * dv) / det, n.v - 2 * (cq * du - cp * eu) / det, 2, i, j);
      }
    }
    Weighted kept[3];
    int count = 0;
    for (int i = 0; i < supports; ++i) kept[count++] = points[support[i]];
    kept[count++] = n;
    std::copy_n(kept, count, points);
    size = count;
    optimum = best;
  }
};

}  // namespace

void shrinkBall(const PointLanes& points, float center[3]) {
  constexpr int kSteps = 16;
  constexpr float kFirst = 0.5F, kDecay = 0.68F;
  float c[3] = {center[0], center[1], center[2]};
  float best = std::numeric_limits<float>::infinity();
  float step = kFirst;
  for (int i = 0; i < kSteps; ++i, step *= kDecay) {
    const auto far = points.farthest(c[0], c[1], c[2]);
    if (far.squared_distance < best) {
      best = far.squared_distance;
      std::copy_n(c, 3, center);
    }
    c[0] += step * (points.x()[far.index] - c[0]);
    c[1] += step * (points.y()[far.index] - c[1]);
    c[2] += step * (points.z()[far.index] - c[2]);
  }
}

void recenterInPlane(const PointLanes& points, int height_axis, float center[3]) {
  constexpr int kRounds = 6;
  constexpr double kGap = 1e-3;
  const float* const coordinates[3] = {points.x(), points.y(), points.z()};
  const int iu = (height_axis + 1) % 3, iv = (height_axis + 2) % 3;
  const double height = center[height_axis];

  CoreSet core;
  float c[3] = {center[0], center[1], center[2]};
  auto far = points.farthest(c[0], c[1], c[2]);
  double best = far.squared_distance;
  for (int round = 0; round < kRounds; ++round) {
    const double h = coordinates[height_axis][far.index] - height;
    core.points[core.size++] = {coordinates[iu][far.index], coordinates[iv][far.index], h * h};
    core.solve();
    if (!(core.optimum < best)) return;
    c[iu] = static_cast<float>(core.u);
    c[iv] = static_cast<float>(core.v);
    far = points.farthest(c[0], c[1], c[2]);
    if (far.squared_distance < best) {
      best = far.squared_distance;
      std::copy_n(c, 3, center);
    }
    if (far.squared_distance <= core.optimum * (1 + kGap)) return;
  }
}

}  // namespace kios
