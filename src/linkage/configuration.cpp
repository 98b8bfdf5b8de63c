// SPDX-FileCopyrightText: 2026 The fcl_kios authors
// SPDX-License-Identifier: BSD-3-Clause
#include "linkage/configuration.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "volume/errors.h"
#include "volume/rotation.h"

namespace kios::articulated {
namespace {

using Eigen::Vector3d;

void requireCoordinates(const Eigen::VectorXd& q, int size, const char* name) {
  if (q.size() == size && (size == 0 || q.lpNorm<Eigen::Infinity>() <= 0x1p300) && q.allFinite()) {
    return;
  }
  if (q.size() != size) {
    refuse(name, " has ", q.size(), " coordinates, but the linkage ", size, ".");
  }
  refuse("a coordinate of ", name, q.allFinite() ? " is too large." : " is NaN or infinite.");
}

}  // namespace

Path::Path(const Linkage::Impl& linkage, const Eigen::VectorXd& q0, const Eigen::VectorXd& q1)
    : linkage_(linkage), q0_(q0), q1_(q1) {
  requireCoordinates(q0, linkage.coordinates, "q0");
  requireCoordinates(q1, linkage.coordinates, "q1");
  constexpr double kSlack = 0x1p-49;  // 16 u
  sweeps_.resize(linkage.links.size());
  for (std::size_t i = 0; i < linkage.links.size(); ++i) {
    const LinkData& link = linkage.links[i];
    Sweep& sweep = sweeps_[i];
    if (link.parent >= 0) sweep = sweeps_[link.parent];
    sweep.rate = 0;
    sweep.length = link.offsets + sweep.travel;
    if (link.coordinate < 0) continue;
    const double a = q0[link.coordinate], b = q1[link.coordinate];
    const double most =
        (std::abs(link.multiplier) * std::max(std::abs(a), std::abs(b)) + std::abs(link.offset)) *
        link.unit;
    sweep.rate = link.multiplier * (b - a) * link.unit;
    if (sweep.rate != 0) {
      ++sweep.moves;
      moves_ = true;
    }
    if (link.type == JointType::kPrismatic) {
      sweep.travel += most * (1 + 0x1p-50);
      sweep.shifts += kSlack * most;
      sweep.slides += std::abs(sweep.rate);
    } else {
      sweep.angles += kSlack * most;
      sweep.turns += std::abs(sweep.rate);
      sweep.arms += std::abs(sweep.rate) * sweep.length;
    }
  }
  shares_.resize(linkage.carried.size() + 1);
  for (const CarriedBody& carried : linkage.carried) {
    const BodyData& body = linkage.bodies[carried.body];
    const LinkData& link = linkage.links[body.link];
    const Sweep& sweep = sweeps_[body.link];
    Share& share = shares_[body.carried + 1];
    share.length =
        (body.X_LB.translation().norm() + body.reach + link.offsets + sweep.travel) * (1 + 0x1p-50);
    share.level = link.level + 2;
    largest_level_ = std::max(largest_level_, share.level);
    share.slack = (sweep.angles * share.length + sweep.shifts) * (1 + 0x1p-50);
  }
}

// The sum of |w_i| (length of the body - length before joint i), as a share's length is that of all
// offsets and travel and of the reach. Each sum rounds by less than u n of itself.
double Path::swept(int body, int shared) const {
  const auto& moving = linkage_.links[linkage_.bodies[body].link].moving;
  if (moving.size() <= static_cast<std::size_t>(shared)) return 0;
  const Sweep& all = sweeps_[moving.back()];
  const Sweep none, &before = shared > 0 ? sweeps_[moving[shared - 1]] : none;
  const Share& share = shares_[slot(body)];
  return (all.turns - before.turns) * share.length - (all.arms - before.arms) +
         (all.slides - before.slides) +
         0x1p-48 * share.level * (all.turns * share.length + all.slides);
}

int Path::movesAfter(int body, int shared) const {
  const int link = linkage_.bodies[body].link;
  if (link < 0) return 0;
  const auto& moving = linkage_.links[link].moving;
  if (moving.size() <= static_cast<std::size_t>(shared)) return 0;
  return sweeps_[moving.back()].moves - (shared > 0 ? sweeps_[moving[shared - 1]].moves : 0);
}

void Configuration::set(const Path& path, double s) {
  path_ = &path;
  s_ = s;
  const auto& links = path.linkage().links;
  links_.resize(links.size());
  for (std::size_t i = 0; i < links.size(); ++i) {
    const LinkData& link = links[i];
    PlacedLink& placed = links_[i];
    if (link.parent < 0) {
      placed.R = link.R_PJ;
      placed.t = link.t_PJ;
    } else {
      const PlacedLink& parent = links_[link.parent];
      placed.R.noalias() = parent.R * link.R_PJ;
      placed.t = parent.t + parent.R * link.t_PJ;
    }
    if (link.coordinate < 0) continue;
    placed.axis = placed.R * link.axis;
    const double value = link.at(path.coordinate(link.coordinate, s));
    if (link.type == JointType::kPrismatic) {
      placed.t += value * placed.axis;
    } else {
      turnAbout(link.axis, value, placed.R);
    }
  }
  placed_.resize(path.linkage().carried.size());
  for (PlacedBody& body : placed_) body.ready = body.moves = false;
  motions_.resize(static_cast<std::size_t>(path.linkage().num_motions));
}

std::vector<MovingJoint> Configuration::jointsOf(int id, int shared) const {
  std::vector<MovingJoint> joints;
  const Linkage::Impl& linkage = path_->linkage();
  const int own = linkage.bodies[id].link;
  if (own < 0) return joints;
  const std::vector<int>& moving = linkage.links[own].moving;
  for (auto i = static_cast<std::size_t>(shared); i < moving.size(); ++i) {
    const PlacedLink& X = links_[moving[i]];
    const double rate = path_->rate(moving[i]);
    if (rate == 0) continue;
    joints.push_back({X.axis, X.t, rate, linkage.links[moving[i]].type == JointType::kRevolute});
  }
  return joints;
}

void Configuration::place(const BodyData& body) const {
  const PlacedLink& link = links_[body.link];
  PlacedBody& placed = placed_[body.carried];
  placed.ready = true;
  placed.X.setIdentity();
  placed.X.linear().noalias() = link.R * body.X_LB.linear();
  placed.X.translation() = link.t + link.R * body.X_LB.translation();
  placed.center = link.t + link.R * body.content.center;
}

// From the last joint to the first, each sum taking in one more joint.
void Configuration::addMotions(const BodyData& body, int id) const {
  placed_[body.carried].moves = true;
  const auto& links = path_->linkage().links;
  const auto& moving = links[body.link].moving;
  const PlacedLink& own = links_[body.link];
  // Both ends of the capsule, one a lane.
  using Eigen::Array2d;
  const Vector3d first = own.t + own.R * body.content.ends[0],
                 last = own.t + own.R * body.content.ends[1];
  const Array2d x(first.x(), last.x()), y(first.y(), last.y()), z(first.z(), last.z());
  const double rounding = path_->axisRounding(id);
  // For the stretch of rotations that are ones to rounding, and for the sums.
  constexpr double kSums = 1 + 0x1p-30;
  constexpr double kLargest = std::numeric_limits<double>::max();  // infinity times 0 is NaN

  BodyMotion* const motions = &motions_[body.first_motion];
  motions[moving.size()] = BodyMotion();
  Vector3d turning = Vector3d::Zero();
  Array2d vx = Array2d::Zero(), vy = vx, vz = vx;
  double most = 0, second = 0, third = 0, outer = 0, rates = 0;
  for (std::size_t i = moving.size(); i-- > 0;) {
    const int link = moving[i];
    const double rate = path_->rate(link), speed = std::abs(rate) * (1 + 0x1p-50);
    const Vector3d &axis = links_[link].axis, &origin = links_[link].t;
    if (speed > 0 && links[link].type == JointType::kPrismatic) {
      vx += rate * axis.x();
      vy += rate * axis.y();
      vz += rate * axis.z();
      most += speed;
    } else if (speed > 0) {
      const Array2d dx = x - origin.x(), dy = y - origin.y(), dz = z - origin.z();
      const Array2d arm_x = axis.y() * dz - axis.z() * dy, arm_y = axis.z() * dx - axis.x() * dz,
                    arm_z = axis.x() * dy - axis.y() * dx;
      double away = std::sqrt((arm_x * arm_x + arm_y * arm_y + arm_z * arm_z).maxCoeff()) +
                    body.content.capsule_radius;
      away += rounding;
      turning += rate * axis;
      vx += rate * arm_x;
      vy += rate * arm_y;
      vz += rate * arm_z;
      second += speed * (speed * away + 2 * most);
      third += speed * (speed * most + 2 * outer);
      outer += speed * most;
      most += speed * away;
      rates += speed;
    }
    BodyMotion& motion = motions[i];
    motion.most = most * kSums;
    motion.ends[0] = {vx[0], vy[0], vz[0]};
    motion.ends[1] = {vx[1], vy[1], vz[1]};
    motion.swing = turning * body.content.capsule_radius;
    motion.rounding = 4 * rounding * rates + 0x1p-40 * most;
    motion.change[0] = second * kSums;
    motion.change[1] = std::min(third * kSums, kLargest);
  }
}

double BodyMotion::during(double time) const {
  const double speed =
      std::sqrt(std::max(ends[0].squaredNorm(), ends[1].squaredNorm())) + swing.norm() + rounding;
  return std::min(most, speed + 0.5 * time * (change[0] + time * change[1])) * time;
}

PairMotion::PairMotion(const BodyMotion& a, const BodyMotion& b)
    : most_(a.most + b.most),
      second_(a.change[0] + b.change[0]),
      third_(a.change[1] + b.change[1]) {
  double square = 0;
  for (const Vector3d& u : a.ends) {
    for (const Vector3d& v : b.ends) square = std::max(square, (u - v).squaredNorm());
  }
  first_ = std::sqrt(square) + a.swing.norm() + b.swing.norm() + a.rounding + b.rounding;
}

// What a distance changes by is convex in time and 0 at 0. Newton's steps come down to the time
// looked for from above, and the chord from 0 then ends below it.
double PairMotion::timeFor(double gap, double longest) const {
  double time = longest, changed = after(time);
  if (changed < gap) return longest;
  const double by_most = std::min(longest, gap / most_);
  if (!(changed < 0x1p500)) return by_most;  // an overflow proves nothing
  for (int step = 0; step < 3; ++step) {
    time -= (changed - gap) / (first_ + time * (second_ + 1.5 * time * third_));
    changed = after(time);
  }
  return std::max(by_most, (changed > gap ? time * (gap / changed) : time) * (1 - 0x1p-45));
}

}  // namespace kios::articulated

namespace kios {

fcl::Transform3d Linkage::pose(int body, const Eigen::VectorXd& q) const {
  impl_->at(body);
  const articulated::Path path(*impl_, q, q);
  return articulated::Configuration(path, 1).pose(body);
}

fcl::Transform3d Linkage::linkPose(int link, const Eigen::VectorXd& q) const {
  if (link < 0 || link >= links()) refuse("the linkage has no link ", link, ".");
  const articulated::Path path(*impl_, q, q);
  return articulated::Configuration(path, 1).linkPose(link);
}

}  // namespace kios
