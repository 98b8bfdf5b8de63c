// SPDX-FileCopyrightText: 2026 The fcl_kios authors
// SPDX-License-Identifier: BSD-3-Clause
#include "search/float_frame.h"

#include <algorithm>
#include <cmath>

#include "tree/prepare.h"
#include "volume/error_bounds.h"
#include "volume/rounding.h"

namespace kios::engine {
namespace {

FloatPose toFloat(const Eigen::Matrix3d& R, const Eigen::Vector3d& t) {
  FloatPose pose;
  for (int i = 0; i < 3; ++i) {
    for (int j = 0; j < 3; ++j) pose.R[i][j] = roundedTo<float>(R(i, j));
    pose.t[i] = roundedTo<float>(t[i]);
  }
  return pose;
}

}  // namespace

[[gnu::hot]] bool makeTreePose(const Tree& a, const Tree& b, const RelativePose<double>& X_AB,
                               TreePose& out) {
  const Eigen::Map<const Eigen::Vector3d> origin_a(a.origin), origin_b(b.origin);
  const detail::PoseBounds& bounds = detail::boundsOf(X_AB);
  out.R = X_AB.R();
  out.t = X_AB * Eigen::Vector3d(origin_b) - origin_a;
  const double reach_a = a.reach, reach_b = b.reach;
  out.scale = reach_a + reach_b + out.t.lpNorm<1>();
  if (a.exponent != 0 || b.exponent != 0 || !(out.scale <= kLargestReach)) return false;
  const double points = error_bounds::volumeError<double>(
      origin_b.lpNorm<1>() + 2 * reach_b, bounds.T_norm1 + origin_a.lpNorm<1>(), 2 * reach_a, 0);
  out.stretch = bounds.stretch;
  out.frame_error = 2 * bounds.stretch * out.scale + points;
  out.pad = error_bounds::laneError(out.scale) + out.frame_error;
  out.box_pad = error_bounds::boxError(out.scale) + out.frame_error;
  // Floats tell nothing of what is smaller than the pad, but what in the other is near it.
  return out.t.lpNorm<1>() <= reach_a + reach_b || out.pad <= std::min(reach_a, reach_b);
}

// The transpose is the inverse but for |R^T R - I| <= 2 stretch + stretch^2, which moves points by
// 3 stretch S.
[[gnu::hot]] void makeFloatFrame(const TreePose& X_AB, FloatFrame& out) {
  const Eigen::Matrix3d inverse = X_AB.R.transpose();
  const double of_inverse = 3 * X_AB.stretch * X_AB.scale;
  out.a_from_b = toFloat(X_AB.R, X_AB.t);
  out.b_from_a = toFloat(inverse, -detail::rotate<double>(inverse, X_AB.t));
  out.pad = roundUpFloat(X_AB.pad + of_inverse);
  out.box_pad = roundUpFloat(X_AB.box_pad + of_inverse);
  out.scale = roundUpFloat(X_AB.scale);
}

}  // namespace kios::engine
