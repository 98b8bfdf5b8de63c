// SPDX-FileCopyrightText: 2026 The fcl_kios authors
// SPDX-License-Identifier: BSD-3-Clause
#include "linkage/slab_motion.h"

#include <algorithm>
#include <cmath>

#include "linkage/tuning.h"

namespace kios::articulated {

using Eigen::Vector3d;

namespace {

constexpr double kMostTurns = 0x1p100;  // whose cubes don't overflow

}  // namespace

SlabMotion::SlabMotion(const Configuration& c, const Pair& pair, bool planes)
    : pad_(c.path().pad(pair.a, pair.b)) {
  add(c, pair.a, pair.shared, pair.direction, planes);
  add(c, pair.b, pair.shared, -pair.direction, planes);
}

// From the last joint to the first, as each turns the velocities of those after it.
void SlabMotion::add(const Configuration& c, int id, int shared, const Vector3d& n, bool planes) {
  const Path& path = c.path();
  const Linkage::Impl& linkage = path.linkage();
  const BodyData& body = linkage.bodies[id];
  if (body.carried < 0) return;
  const auto& moving = linkage.links[body.link].moving;
  const auto first =
      moving.begin() + std::min<std::ptrdiff_t>(shared, moving.end() - moving.begin());
  const fcl::Transform3d& X = c.pose(id);
  const ContentBound& content = body.own->content;
  const Vector3d ends[2] = {X.linear() * content.ends[0], X.linear() * content.ends[1]};
  const double radius = content.capsule_radius + path.axisRounding(id);
  double turns = 0;  // |w| up to the joint at hand
  for (auto i = first; i != moving.end(); ++i) {
    if (linkage.links[*i].type == JointType::kRevolute) turns += std::abs(path.rate(*i));
  }
  Vector3d velocity = Vector3d::Zero(), turning = velocity, second = velocity;
  double change = 0, most = 0;  // what the joints after it move the body by
  turns_ += turns;
  if (!(turns < kMostTurns)) return;
  for (auto i = moving.end(); i != first;) {
    const Configuration::PlacedLink& joint = c.link(*--i);
    const double rate = path.rate(*i), speed = std::abs(rate);
    const Vector3d w = rate * joint.axis;
    if (linkage.links[*i].type == JointType::kPrismatic) {
      velocity += w;
      jerk_ += 3 * turns * turns * speed;
      most += speed;
      continue;
    }
    const Vector3d arm = X.translation() - joint.t, by_itself = w.cross(arm), across = n.cross(w);
    change += across.dot(by_itself + 2 * velocity);
    second += across.cross(w + 2 * turning);
    velocity += by_itself;
    turning += w;
    const double away = radius + std::sqrt(std::max(joint.axis.cross(arm + ends[0]).squaredNorm(),
                                                    joint.axis.cross(arm + ends[1]).squaredNorm()));
    const double before = std::max(0.0, turns - speed),
                 triples = turns * turns * turns - before * before * before;
    jerk_ += triples * away;
    growth_ += triples * most;
    most += speed * away;
    turns = before;
  }
  Side& side = sides_[count_++];
  side.supports = &body.own->supports;
  side.depth = planes ? Vector3d(X.linear().transpose() * n) : Vector3d::Zero();
  side.support = planes ? side.supports->along(side.depth) : 0;
  side.first = X.linear().transpose() * n.cross(turning);
  side.second = X.linear().transpose() * second;
  side.speed = n.dot(velocity);
  side.change = change;
  rounding_ += c.motion(id, shared).rounding;
}

// Velocities and accelerations round as those of BodyMotion, and supports as the path's pad says.
double SlabMotion::used(double p, double q) const {
  double sum = (std::abs(p) + 4 * turns_ * q) * rounding_;
  for (int i = 0; i < count_; ++i) {
    const Side& side = sides_[i];
    const Vector3d along = side.depth + p * side.first + q * side.second;
    sum += side.supports->along(along) - side.support + p * side.speed + q * side.change +
           pad_ * (1 + along.lpNorm<1>());
  }
  return sum;
}

double SlabMotion::usedUpTo(double time, double sign) const {
  constexpr double kSums = 1 + 0x1p-30;
  const double third = kSums * time * time * time / 6 * (jerk_ + time * growth_);
  const double most = std::max(used(sign * time, 0.5 * time * time), used(0.5 * sign * time, 0));
  return std::max(0.0, most) + third;
}

double SlabMotion::timeFor(double gap, double sign, double longest) const {
  if (!(turns_ < kMostTurns)) return 0;
  double time = longest;
  for (int i = 0; i < tuning::kTries; ++i) {
    const double sum = usedUpTo(time, sign);
    if (sum < gap) return time;
    time *= std::clamp(0.95 * std::sqrt(gap / sum), 0.1, 0.9);
  }
  return 0;
}

}  // namespace kios::articulated
