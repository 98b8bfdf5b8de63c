// SPDX-FileCopyrightText: 2026 The fcl_kios authors
// SPDX-License-Identifier: BSD-3-Clause
#include "linkage/box_search.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include "continuous/tuning.h"
#include "linkage/tuning.h"

namespace kios::articulated {

using Eigen::VectorXd;

namespace {

VectorXd placeOf(const std::vector<double>& at) {
  return Eigen::Map<const VectorXd>(at.data(), static_cast<Eigen::Index>(at.size()));
}

std::vector<double> middleOf(const Path& path) {
  std::vector<double> q(static_cast<std::size_t>(path.linkage().coordinates));
  for (std::size_t k = 0; k < q.size(); ++k) q[k] = path.coordinate(static_cast<int>(k), 0.5);
  return q;
}

}  // namespace

BoxSearch::BoxSearch(const Linkage::Impl& linkage, const Pair* only, const RangeRequest& request)
    : linkage_(linkage), request_(request), nearest_(only), seen_(request) {}

void BoxSearch::look(const VectorXd& q) {
  const Path path(linkage_, q, q);
  seen_.keep(nearest_.at(Configuration(path, 1), seen_.far(), continuous::tuning::kCoarseError),
             {q.data(), q.data() + q.size()});
}

void BoxSearch::descend(const VectorXd& low, const VectorXd& high) {
  VectorXd step = 0.25 * (high - low);
  for (int round = 0; round < tuning::kRounds && seen_.distance() > 0 && !spent(); ++round) {
    const double before = seen_.distance();
    for (Eigen::Index k = 0; k < step.size() && !spent(); ++k) {
      if (!(step[k] > 0)) continue;
      for (const double side : {-step[k], step[k]}) {
        VectorXd q = placeOf(seen_.at());
        q[k] = std::clamp(q[k] + side, low[k], high[k]);
        if (q[k] != seen_.at()[static_cast<std::size_t>(k)]) look(q);
      }
    }
    if (!(seen_.distance() < before)) step *= 0.25;
  }
}

void BoxSearch::addSteps(const Configuration& c, const Pair& pair, int side) {
  const Path& path = c.path();
  const int own = linkage_.bodies[side].link;
  if (own < 0) return;
  const double pad = path.pad(pair.a, pair.b);
  const auto& moving = linkage_.links[own].moving;
  for (auto i = static_cast<std::size_t>(pair.shared); i < moving.size(); ++i) {
    const LinkData& link = linkage_.links[moving[i]];
    const Configuration::PlacedLink& placed = c.link(moving[i]);
    // A path's middle is off by a rounding of its ends.
    const double half = 0.5 * std::abs(path.rate(moving[i])) * (1 + 0x1p-30);
    if (!(half > 0)) continue;
    const auto moves = [&](int id) {
      const BodyData& body = linkage_.bodies[id];
      if (link.type == JointType::kPrismatic) return half;
      if (!body.bounded) return kInfinity;
      double square = 0;
      for (const Eigen::Vector3d& end : body.content.ends) {
        const Eigen::Vector3d x =
            body.link < 0 ? end : c.link(body.link).t + c.link(body.link).R * end;
        square = std::max(square, placed.axis.cross(x - placed.t).squaredNorm());
      }
      return half * (std::sqrt(square) + body.content.capsule_radius + pad);
    };
    const double angle = link.type == JointType::kPrismatic ? 0 : half;
    steps_.push_back({link.coordinate, moves(pair.a), moves(pair.b), angle, placed.axis});
  }
}

double BoxSearch::moved(const Configuration& c, const Pair& pair, VectorXd& parts) {
  steps_.clear();
  seen_from_ = 0;
  addSteps(c, pair, pair.a);
  std::reverse(steps_.begin(), steps_.end());
  addSteps(c, pair, pair.b);
  double least = kInfinity;
  for (std::size_t cut = 0; cut <= steps_.size(); ++cut) {
    double sum = 0;
    for (std::size_t i = 0; i < steps_.size(); ++i)
      sum += i < cut ? steps_[i].of_a : steps_[i].of_b;
    if (!(sum < least)) continue;
    least = sum;
    seen_from_ = cut;
  }
  parts = VectorXd::Zero(linkage_.coordinates);
  for (std::size_t i = 0; i < steps_.size(); ++i) {
    parts[steps_[i].coordinate] += i < seen_from_ ? steps_[i].of_a : steps_[i].of_b;
  }
  return least * (1 + 0x1p-40);
}

double BoxSearch::slabs(const Configuration& c, const Pair& pair, VectorXd& parts) const {
  if (!linkage_.bodies[pair.a].bounded || !linkage_.bodies[pair.b].bounded) return -kInfinity;
  const Eigen::Vector3d between = c.center(pair.b) - c.center(pair.a);
  VectorXd own(linkage_.coordinates);
  double best = -kInfinity;
  for (std::size_t k = 0; k <= steps_.size(); ++k) {
    Eigen::Vector3d n = k < steps_.size() ? steps_[k].axis : pair.direction, on_a, on_b;
    if (n.dot(between) < 0) n = -n;
    double turned = 0;
    own.setZero();
    const auto add = [&](const Step& step, double moves) {
      const double share = step.angle > 0 ? n.cross(step.axis).norm() : std::abs(n.dot(step.axis));
      const double most = std::min(1.0, share + turned + 0x1p-40);
      own[step.coordinate] += moves * most;
      turned += step.angle * most;
    };
    for (std::size_t i = seen_from_; i-- > 0;) add(steps_[i], steps_[i].of_a);
    turned = 0;
    for (std::size_t i = seen_from_; i < steps_.size(); ++i) add(steps_[i], steps_[i].of_b);
    const double way = own.sum() * (1 + 0x1p-40) + c.path().pad(pair.a, pair.b);
    if (!(n.dot(between) - way > best)) continue;  // no wider is likely
    const double width = -c.support(pair.b, -n, on_b) - c.support(pair.a, n, on_a);
    if (!(width > 0 && width - way > best)) continue;
    best = width - way;
    parts = own;
  }
  return best;
}

void BoxSearch::open(Task task) {
  const Path path(linkage_, task.low, task.high);
  const Configuration c(path, 0.5);
  Pair& pair = task.pair;
  VectorXd parts;
  const double way = moved(c, pair, parts);
  VectorXd slab_parts = parts;
  const double slab = slabs(c, pair, slab_parts);
  task.bound = std::max(task.bound, slab);
  if (task.bound >= seen_.enough()) {
    settled_ = std::min(settled_, task.bound);
    return;
  }
  // Where much is taken off, little need be known of what it is taken off from.
  const double rel_err =
      std::max(seen_.fineError(), std::min(1.0, tuning::kOfMotion * way / seen_.far()));
  const Nearest::Distance near = nearest_.of(pair, c, (seen_.far() + way) * (1 + 0x1p-40), rel_err);
  if (near.upper.distance < seen_.far()) {
    seen_.keep(near.upper, middleOf(path));
    descend(task.low, task.high);
  }
  task.bound = std::max(task.bound, near.lower - way);
  // Halved is what has to shrink by the smaller factor to leave enough.
  const double slab_way = slab_parts.sum(), enough = seen_.enough();
  const double left = slab + slab_way - enough;
  if (left > 0 && slab_way * (near.lower - enough) < way * left) parts = slab_parts;
  Eigen::Index widest = 0;
  const double most = parts.size() > 0 ? parts.maxCoeff(&widest) : 0;
  const double middle = most > 0 ? path.coordinate(static_cast<int>(widest), 0.5) : 0;
  const bool splits = most > 0 && task.low[widest] < middle && middle < task.high[widest];
  if (task.bound >= seen_.enough() || !splits) {
    settled_ = std::min(settled_, task.bound);
    return;
  }
  Task upper = task;
  upper.low[widest] = task.high[widest] = middle;
  upper.number = ++numbers_;
  task.number = ++numbers_;
  waiting_.push(std::move(upper));
  waiting_.push(std::move(task));
}

RangeResult BoxSearch::run(const VectorXd& low, const VectorXd& high) {
  const Path path(linkage_, low, high);
  const Configuration middle(path, 0.5);
  look(placeOf(middleOf(path)));
  if (seen_.distance() < kInfinity) descend(low, high);
  VectorXd parts;
  // Volumes in the middle leave out what stays beyond all that counts.
  for (const auto& [bound, pair] : nearest_.pairs(middle, kInfinity)) {
    const double way = moved(middle, pair, parts);
    waiting_.push({std::max(0.0, bound - way), pair, low, high, ++numbers_});
  }
  while (!waiting_.empty() && waiting_.top().bound < seen_.enough() && !spent()) {
    Task task = waiting_.top();
    waiting_.pop();
    open(std::move(task));
  }
  const double left = waiting_.empty() ? kInfinity : waiting_.top().bound;
  const double lower = std::min({left, settled_, seen_.ceiling(), seen_.distance()});
  return seen_.result(lower, nearest_.queries());
}

}  // namespace kios::articulated
