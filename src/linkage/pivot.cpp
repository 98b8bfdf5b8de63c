// SPDX-FileCopyrightText: 2026 The fcl_kios authors
// SPDX-License-Identifier: BSD-3-Clause
#include "linkage/pivot.h"

#include <algorithm>
#include <cmath>

#include <Eigen/Dense>

namespace kios::articulated {
namespace {

using Eigen::Matrix3d;
using Eigen::Vector3d;

/// A joint that moves one of two bodies against the other, at a configuration.
struct Moving {
  Vector3d axis, origin;
  double way;  ///< >= its turn, or slide, from there to either end of the path
  bool turns;
};

std::vector<Moving> jointsBetween(const Path& path, const Pair& pair, const Configuration& at) {
  const Linkage::Impl& linkage = path.linkage();
  const double time = std::max(at.s(), 1 - at.s()) * (1 + 0x1p-40);
  std::vector<Moving> joints;
  for (const int body : {pair.a, pair.b}) {
    const int link = linkage.bodies[body].link;
    if (link < 0) continue;
    const std::vector<int>& moving = linkage.links[link].moving;
    for (std::size_t i = static_cast<std::size_t>(pair.shared); i < moving.size(); ++i) {
      const double way = std::abs(path.rate(moving[i])) * time;
      if (!(way > 0)) continue;
      const fcl::Transform3d X = at.linkPose(moving[i]);
      const LinkData& data = linkage.links[moving[i]];
      joints.push_back(
          {X.linear() * data.axis, X.translation(), way, data.type == JointType::kRevolute});
    }
  }
  return joints;
}

/// Finds the slack of a pivot that all points to be looked at are within `reach` of.
class Slack {
 public:
  Slack(const std::vector<Moving>& joints, double rounding)
      : joints_(joints), rounding_(rounding) {}

  void set(Pivot& pivot, double reach) const {
    if (!pivot.isLine()) {
      pivot.slack = pivot.height_slack = of(pivot, pivot.point);
      return;
    }
    double slides = 0;
    for (const Moving& joint : joints_) slides += joint.turns ? 0 : joint.way;
    const Vector3d arm = (reach + slides) * (1 + 0x1p-40) * pivot.axis;
    pivot.slack = std::max(of(pivot, pivot.point + arm), of(pivot, pivot.point - arm));
    // Where the ends of the copies come apart by so much, they turn by this over the length.
    pivot.height_slack = 2 * pivot.slack + slides;
  }

 private:
  /// The way of a point of the line, across it but for what joints turn.
  double of(const Pivot& pivot, const Vector3d& p) const {
    double sum = 0;
    for (const Moving& joint : joints_) {
      if (joint.turns) {
        sum += joint.way * (joint.axis.cross(p - joint.origin).norm() + rounding_);
      } else {
        const Vector3d across = joint.axis - pivot.axis.dot(joint.axis) * pivot.axis;
        sum += joint.way * (across.norm() + 0x1p-43);
      }
    }
    return sum * (1 + 0x1p-40);
  }

  const std::vector<Moving>& joints_;
  const double rounding_;
};

/// The point that is nearest to all axes, each weighed by its turn.
Vector3d meetingPoint(const std::vector<Moving>& joints, const Vector3d& near) {
  Matrix3d M = Matrix3d::Zero();
  Vector3d sum = Vector3d::Zero();
  for (const Moving& joint : joints) {
    if (!joint.turns) continue;
    const Matrix3d across = Matrix3d::Identity() - joint.axis * joint.axis.transpose();
    M += joint.way * across;
    sum += joint.way * (across * (joint.origin - near));
  }
  return near + M.ldlt().solve(sum);
}

}  // namespace

std::vector<Pivot> pivotsOf(const Path& path, const Pair& pair, const Configuration& at) {
  const BodyData &a = path.linkage().bodies[pair.a], &b = path.linkage().bodies[pair.b];
  const std::vector<Moving> joints = jointsBetween(path, pair, at);
  const auto turns =
      std::count_if(joints.begin(), joints.end(), [](const Moving& joint) { return joint.turns; });
  if (turns == 0 || !a.bounded || !b.bounded) return {};
  const bool a_is_smaller = a.content.radius < b.content.radius;
  const Vector3d& middle = at.center(a_is_smaller ? pair.a : pair.b);
  const double radius = a_is_smaller ? a.content.radius : b.content.radius;
  const double lengths = path.length(pair.a) + path.length(pair.b);
  const Slack slack(joints, path.pad(pair.a, pair.b) + 0x1p-43 * lengths);
  std::vector<Pivot> found;
  const auto offer = [&](Pivot pivot) {
    const double off = (pivot.point - middle).norm();
    if (!(off <= 2 * lengths)) return;   // rounding counts on that
    slack.set(pivot, off + 2 * radius);  // from any copy, as the slack is less than the radius
    if (!(pivot.slack < radius)) return;
    if (!found.empty() && found.back().isLine() == pivot.isLine()) {
      if (!(pivot.slack < found.back().slack)) return;
      found.pop_back();
    }
    found.push_back(pivot);
  };
  for (const Moving& joint : joints) {
    if (!joint.turns) continue;
    const Vector3d axis = joint.axis.normalized();
    offer({joint.origin + axis.dot(middle - joint.origin) * axis, axis});
  }
  if (turns > 1) offer({meetingPoint(joints, middle)});
  return found;
}

}  // namespace kios::articulated
