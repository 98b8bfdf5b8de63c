// SPDX-FileCopyrightText: 2026 The fcl_kios authors
// SPDX-License-Identifier: BSD-3-Clause
#include "solid/ball_pairs.h"

#include <algorithm>

namespace kios {
namespace {

/// Eigen's root of 0 multiplies it by infinity, which some programs trap: what is less counts as 0.
constexpr float kLeastSquare = 0x1p-126F, kLeastRoot = 0x1p-62F;

}  // namespace

template <typename S>
BallPairs::BallPairs(const SolidPair<S>& pair)
    : a_(pair.stateA().balls(pair.frame().a).balls),
      b_(pair.stateB().balls(pair.frame().b).balls),
      gap_(pair.stateA().balls(pair.frame().a).gap + pair.stateB().balls(pair.frame().b).gap),
      unit_(pair.size()) {
  for (InnerBalls::Ball& q : b_) q.center = pair.R_AB() * q.center + pair.T_AB();
  const auto n = static_cast<Eigen::Index>(a_.size() * b_.size());
  for (auto* const lanes : {&x_, &y_, &z_, &square_, &radius_, &inner_square_, &middle_, &half_}) {
    lanes->resize(n);
  }
  Eigen::Index i = 0;
  for (const InnerBalls::Ball& q : b_) {
    for (const InnerBalls::Ball& p : a_) {
      const Eigen::Vector3f d = ((p.center - q.center) / unit_).cast<float>();
      x_[i] = d[0];
      y_[i] = d[1];
      z_[i] = d[2];
      radius_[i] = static_cast<float>((p.radius + q.radius) / unit_);
      ++i;
    }
  }
  square_ = x_ * x_ + y_ * y_ + z_ * z_;
  constexpr float kSurely = 0.999F;
  inner_square_ = kSurely * radius_ * radius_;
}

double BallPairs::reach(const fcl::Vector3d& n, double grown) const {
  const Eigen::Vector3f d = n.cast<float>();
  middle_ = d[0] * x_ + d[1] * y_ + d[2] * z_;
  const auto more = static_cast<float>(grown / unit_);
  half_ = (middle_ * middle_ - square_ + (radius_ + more).square()).max(kLeastSquare).sqrt();
  chords_.clear();
  for (Eigen::Index i = 0; i < half_.size(); ++i) {
    if (half_[i] > kLeastRoot && middle_[i] + half_[i] > 0) {
      chords_.emplace_back(middle_[i] - half_[i], middle_[i] + half_[i]);
    }
  }
  float reach = 0;
  for (bool farther = true; farther;) {
    farther = false;
    for (const auto& [enter, leave] : chords_) {
      if (leave <= reach || enter > reach) continue;
      reach = leave;
      farther = true;
    }
  }
  return unit_ * double{reach};
}

std::vector<BallPairs::Way> BallPairs::ways(const std::vector<fcl::Vector3d>& directions) const {
  std::vector<Way> ways;
  const auto add = [&](const fcl::Vector3d& n) { ways.push_back({n, reach(n, gap_)}); };
  for (const fcl::Vector3d& n : directions) add(n);
  for (int c = 0; c < 3; ++c) {
    add(fcl::Vector3d::Unit(c));
    add(-fcl::Vector3d::Unit(c));
  }
  for (int i = 0; i < 8; ++i) {
    constexpr double k = 0.57735026918962576;
    add({(i & 1) != 0 ? k : -k, (i & 2) != 0 ? k : -k, (i & 4) != 0 ? k : -k});
  }
  std::stable_sort(ways.begin(), ways.end(),
                   [](const Way& a, const Way& b) { return a.reach < b.reach; });
  return ways;
}

bool BallPairs::meet(const fcl::Vector3d& translation) const {
  if (radius_.size() == 0) return false;
  const Eigen::Vector3f t = (translation / unit_).cast<float>();
  middle_ = (x_ - t[0]).square() + (y_ - t[1]).square() + (z_ - t[2]).square() - inner_square_;
  return middle_.minCoeff() < 0;
}

std::optional<fcl::Vector3d> BallPairs::common() const {
  double deepest = 0;
  std::optional<fcl::Vector3d> point;
  for (const InnerBalls::Ball& p : a_) {
    for (const InnerBalls::Ball& q : b_) {
      const fcl::Vector3d between = q.center - p.center;
      const double apart = between.norm(), depth = p.radius + q.radius - apart;
      if (!(depth > deepest)) continue;
      deepest = depth;
      // The middle of what they share of the line through the centres.
      const double near = std::max(-p.radius, apart - q.radius),
                   far = std::min(p.radius, apart + q.radius);
      const double share = apart > 0 ? 0.5 * (near + far) / apart : 0.0;
      point = p.center + share * between;
    }
  }
  return point;
}

fcl::Vector3d BallPairs::escape(const fcl::Vector3d& from, double grown) const {
  if (radius_.size() == 0) return from;
  Eigen::Vector3f t = (from / unit_).cast<float>();
  const auto more = static_cast<float>(grown / unit_);
  constexpr int kSteps = 12;
  constexpr float kBeyond = 1.02F;
  for (int i = 0; i < kSteps; ++i) {
    middle_ = ((x_ - t[0]).square() + (y_ - t[1]).square() + (z_ - t[2]).square())
                  .max(kLeastSquare)
                  .sqrt();
    half_ = radius_ + more - middle_;
    const float depth = half_.maxCoeff();
    if (!(depth > 0)) break;
    Eigen::Index deepest = 0;
    while (half_[deepest] != depth) ++deepest;
    const float apart = middle_[deepest];
    if (!(apart > kLeastRoot)) break;
    const Eigen::Vector3f center(x_[deepest], y_[deepest], z_[deepest]);
    t = center + (kBeyond * (radius_[deepest] + more) / apart) * (t - center);
  }
  return unit_ * t.cast<double>();
}

template BallPairs::BallPairs(const SolidPair<double>&);
template BallPairs::BallPairs(const SolidPair<float>&);

}  // namespace kios
