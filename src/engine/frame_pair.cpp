// SPDX-FileCopyrightText: 2026 The fcl_kios authors
// SPDX-License-Identifier: BSD-3-Clause
#include "engine/frame_pair.h"

#include <Eigen/LU>
#include <algorithm>
#include <cmath>

#include "engine/prepare.h"
#include "volume/error_bounds.h"
#include "volume/rounding.h"

namespace kios::engine {
namespace {

FloatPose toFloat(const Eigen::Matrix3d& R, const Eigen::Vector3d& t) {
  FloatPose pose;
  for (int i = 0; i < 3; ++i) {
    for (int j = 0; j < 3; ++j) pose.R[i][j] = static_cast<float>(R(i, j));
    pose.t[i] = static_cast<float>(t[i]);
  }
  return pose;
}

}  // namespace

template <typename S>
bool makeFramePair(const Tree& a, const Tree& b, const RelativePose<S>& X_AB, FramePair& out) {
  const Eigen::Map<const Eigen::Vector3d> origin_a(a.origin), origin_b(b.origin);
  const Eigen::Matrix3d R = X_AB.R().template cast<double>();
  const Eigen::Vector3d t =
      detail::rotate<double>(R, origin_b) + X_AB.T().template cast<double>() - origin_a;
  const double reach_a = a.reach, reach_b = b.reach, scale = reach_a + reach_b + t.lpNorm<1>();
  if (!(std::min(reach_a, reach_b) >= kLeastReach && scale <= kLargestReach)) return false;
  const double points = error_bounds::volumeError<S>(
      origin_b.lpNorm<1>() + 2 * reach_b, detail::boundsOf(X_AB).T_norm1 + origin_a.lpNorm<1>(),
      2 * reach_a, 0);
  const double pad =
      error_bounds::laneError(scale) + 2 * detail::boundsOf(X_AB).stretch * scale + points;
  if (!(pad <= 0x1p-4 * std::min(reach_a, reach_b))) return false;
  const Eigen::Matrix3d inverse = R.inverse();
  out.a_from_b = toFloat(R, t);
  out.b_from_a = toFloat(inverse, -detail::rotate<double>(inverse, t));
  out.pad = roundUpFloat(pad);
  out.box_pad =
      roundUpFloat(pad + (error_bounds::boxError(scale) - error_bounds::laneError(scale)));
  out.scale = roundUpFloat(scale);
  return true;
}

template bool makeFramePair(const Tree&, const Tree&, const RelativePose<double>&, FramePair&);
template bool makeFramePair(const Tree&, const Tree&, const RelativePose<float>&, FramePair&);

}  // namespace kios::engine
