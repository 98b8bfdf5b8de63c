// SPDX-FileCopyrightText: 2026 The fcl_kios authors
// SPDX-License-Identifier: BSD-3-Clause
#include "linkage/chain.h"

#include <algorithm>
#include <cmath>

#include "volume/rotation.h"

namespace kios::articulated {

using Eigen::Matrix3d;
using Eigen::Vector3d;

Chain::Chain(const Path& path, int body, int shared) : path_(path), body_(body) {
  const Linkage::Impl& linkage = path.linkage();
  const int own = linkage.bodies[body].link;
  if (own < 0) return;
  const int last = shared > 0 ? linkage.links[own].moving[shared - 1] : -1;
  for (int link = own; link != last; link = linkage.links[link].parent) links_.push_back(link);
  std::reverse(links_.begin(), links_.end());
  for (const int link : links_) {
    const LinkData& data = linkage.links[link];
    if (data.coordinate < 0 || path.rate(link) == 0) continue;
    if (data.type == JointType::kPrismatic) {
      slides_after_ |= turning_ > 0;
    } else {
      ++turning_;
    }
  }
}

void Chain::advance(Place& place, int link, double s) const {
  const LinkData& data = path_.linkage().links[link];
  place.t += place.R * data.t_PJ;
  place.R = (place.R * data.R_PJ).eval();
  if (data.coordinate < 0) return;
  const double value = data.at(path_.coordinate(data.coordinate, s));
  if (data.type == JointType::kPrismatic) {
    place.t += place.R * (value * data.axis);
  } else {
    turnAbout(data.axis, value, place.R);
  }
}

fcl::Transform3d Chain::pose(double s) const {
  Place place = {Matrix3d::Identity(), Vector3d::Zero()};
  for (const int link : links_) advance(place, link, s);
  const fcl::Transform3d& X_LB = path_.linkage().bodies[body_].X_LB;
  fcl::Transform3d X = fcl::Transform3d::Identity();
  X.linear() = place.R * X_LB.linear();
  X.translation() = place.t + place.R * X_LB.translation();
  return X;
}

// The origin is the last axis that turns the body, unless that slides along it: then the body's.
// With one axis that is all, the origin moves on a line. Else, with w_i the rate of joint i,
//   |origin''| <= sum_i |w_i| rho_i (|w_i| + 2 sum_(j < i) |w_j|)
// as in configuration.h, rho_i grown by what the joints after i move the origin by. Relative to the
// origin a point at the distance r has an acceleration of at most (|w'| + |w|^2) r, w the sum of
// all w_i along their axes, and |w'| <= sum_i sum_(j < i) |w_i| |w_j|.
continuous::VelocityField Chain::velocities(double s, const fcl::Transform3d& X,
                                            double window) const {
  const auto& links = path_.linkage().links;
  continuous::VelocityField v;
  v.linear = v.angular = v.acceleration_at[0] = v.acceleration_at[1] = Vector3d::Zero();
  v.origin = X.translation();
  v.axis = Vector3d::UnitX();
  v.fixed_axis = turning_ <= 1;
  v.angular_speed = v.turn_acceleration = 0;

  struct Moving {
    Vector3d axis, origin;
    double rate;
    bool turns;
  };
  std::vector<Moving> moving;
  Place place = {Matrix3d::Identity(), Vector3d::Zero()};
  for (const int link : links_) {
    advance(place, link, s);
    const LinkData& data = links[link];
    if (data.coordinate < 0 || path_.rate(link) == 0) continue;
    const bool turns = data.type == JointType::kRevolute;
    moving.push_back({place.R * data.axis, place.t, path_.rate(link), turns});
    if (!turns) continue;
    v.axis = moving.back().axis;
    if (!slides_after_) v.origin = place.t;
  }
  double after = 0, acceleration = 0, before = 0;  // sums of |w_j| before a joint
  for (const Moving& joint : moving) {
    if (joint.turns) {
      const double rate = std::abs(joint.rate);
      v.turn_acceleration += rate * before;
      before += rate;
    }
  }
  v.angular_speed = before;
  v.turn_acceleration += before * before;
  for (std::size_t i = moving.size(); i-- > 0;) {
    const Moving& joint = moving[i];
    const double rate = std::abs(joint.rate);
    if (!joint.turns) {
      v.linear += joint.rate * joint.axis;
      acceleration += 2 * rate * before;
      after += rate;
      continue;
    }
    before = std::max(0.0, before - rate);
    const Vector3d arm = joint.axis.cross(v.origin - joint.origin);
    v.linear += joint.rate * arm;
    v.angular += joint.rate * joint.axis;
    const double far = arm.norm() + window * after;
    acceleration += rate * far * (rate + 2 * before);
    after += rate * far;
  }
  constexpr double kSums = 1 + 0x1p-30;
  v.angular_speed *= kSums;
  v.turn_acceleration *= kSums;
  // Exactly on the axis, the origin is only moved by joints that slide before it.
  v.origin_acceleration = steady() ? 0 : acceleration * kSums;
  return v;
}

double Chain::rounding(double reach) const {
  double rates = 0, slides = 0;
  for (const int link : links_) {
    const LinkData& data = path_.linkage().links[link];
    if (data.coordinate < 0) continue;
    (data.type == JointType::kPrismatic ? slides : rates) += std::abs(path_.rate(link));
  }
  return 0x1p-40 * (rates * (path_.length(body_) + reach) + slides);
}

}  // namespace kios::articulated
