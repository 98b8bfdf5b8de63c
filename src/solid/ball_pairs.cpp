// SPDX-FileCopyrightText: 2026 The fcl_kios authors
// SPDX-License-Identifier: BSD-3-Clause
#include "solid/ball_pairs.h"

#include <algorithm>
#include <cmath>

#include "volume/rounding.h"

namespace kios {
template <typename S>
BallPairs::BallPairs(const SolidPair<S>& pair) : unit_(pair.size()) {
  const InnerBalls &a = pair.stateA().balls(pair.a()), &b = pair.stateB().balls(pair.b());
  const auto n = static_cast<Eigen::Index>(a.balls.size() * b.balls.size());
  for (auto* const lanes : {&x_, &y_, &z_, &inner_square_, &grown_square_}) lanes->resize(n);
  Eigen::Index i = 0;
  for (const InnerBalls::Ball& in_b : b.balls) {
    const InnerBalls::Ball q = {pair.R_AB() * in_b.center + pair.T_AB(), in_b.radius};
    for (const InnerBalls::Ball& p : a.balls) {
      const Eigen::Vector3d between = q.center - p.center;
      const Eigen::Vector3f d = roundedTo<float>(-between / unit_);
      x_[i] = d[0];
      y_[i] = d[1];
      z_[i] = d[2];
      const double radius = (p.radius + q.radius) / unit_, grown = radius + (a.gap + b.gap) / unit_;
      constexpr double kSurely = 0.999;
      inner_square_[i] = roundedTo<float>(kSurely * radius * radius);
      grown_square_[i] = roundedTo<float>(grown * grown);
      ++i;
      const double apart = between.norm(), depth = p.radius + q.radius - apart;
      if (!(depth > depth_)) continue;
      depth_ = depth;
      // The middle of what they share of the line through the centres.
      const double near = std::max(-p.radius, apart - q.radius),
                   far = std::min(p.radius, apart + q.radius);
      const double share = apart > 0 ? 0.5 * (near + far) / apart : 0.0;
      common_ = p.center + share * between;
    }
  }
}

bool BallPairs::meet(const fcl::Vector3d& translation) const {
  if (inner_square_.size() == 0) return false;
  const Eigen::Vector3f t = roundedTo<float>(translation / unit_);
  depth_in_ = inner_square_ - (x_ - t[0]).square() - (y_ - t[1]).square() - (z_ - t[2]).square();
  return depth_in_.maxCoeff() > 0;
}

fcl::Vector3d BallPairs::escape(const fcl::Vector3d& from) const {
  if (grown_square_.size() == 0) return from;
  Eigen::Vector3f t = roundedTo<float>(from / unit_);
  constexpr int kSteps = 12;
  constexpr float kBeyond = 1.02F;
  for (int i = 0; i < kSteps; ++i) {
    depth_in_ = grown_square_ - (x_ - t[0]).square() - (y_ - t[1]).square() - (z_ - t[2]).square();
    const float depth = depth_in_.maxCoeff();
    if (!(depth > 0)) break;
    Eigen::Index deepest = 0;
    while (depth_in_[deepest] != depth) ++deepest;
    const Eigen::Vector3f center(x_[deepest], y_[deepest], z_[deepest]), way = t - center;
    const float apart = way.norm();
    if (!(apart > 0)) break;
    t = center + kBeyond * std::sqrt(grown_square_[deepest]) / apart * way;
  }
  return unit_ * t.cast<double>();
}

template BallPairs::BallPairs(const SolidPair<double>&);
template BallPairs::BallPairs(const SolidPair<float>&);

}  // namespace kios
