// SPDX-FileCopyrightText: 2026 The fcl_kios authors
// SPDX-License-Identifier: BSD-3-Clause
#include "pair_search.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <random>

#include "pair_query.h"
#include "volume/rotation.h"
#include "volume/rounding.h"

namespace kios::robot {
namespace {

using Eigen::Vector3d;
using fcl::Transform3d;

}  // namespace

PairSearch::PairSearch(const Arm& arm, int link_a, int link_b) : arm_(arm) {
  const KinematicTree& tree = arm.tree;
  a_.node = tree.nodeOf(link_a);
  b_.node = tree.nodeOf(link_b);
  std::vector<char> above_a(tree.size(), 0), above_b(tree.size(), 0);
  for (int n = a_.node; n >= 0; n = tree.parent(n)) above_a[static_cast<std::size_t>(n)] = 1;
  for (int n = b_.node; n >= 0; n = tree.parent(n)) above_b[static_cast<std::size_t>(n)] = 1;
  for (std::size_t n = 0; n < tree.size(); ++n) {
    if (above_a[n] != 0 && above_b[n] != 0) shared_ = static_cast<int>(n);
    if (above_a[n] != above_b[n]) nodes_.push_back(static_cast<int>(n));
  }
  placed_.resize(tree.size());
  placed_[static_cast<std::size_t>(shared_)].R.setIdentity();
  placed_[static_cast<std::size_t>(shared_)].t.setZero();
  for (const int n : nodes_) {
    const KinematicTree::Node& node = tree.node(n);
    if (node.joint.type == JointType::kFixed) continue;
    const auto known = std::find(coordinates_.begin(), coordinates_.end(), node.joint.coordinate);
    const int slot = static_cast<int>(known - coordinates_.begin());
    if (known == coordinates_.end()) coordinates_.push_back(node.joint.coordinate);
    const double scale = std::abs(node.joint.multiplier) * node.unit * (1 + 0x1p-50);
    joints_.push_back({n, slot, scale, node.joint.type == JointType::kPrismatic,
                       above_a[static_cast<std::size_t>(n)] != 0});
  }
  for (const Body& body : arm.bodies) {
    for (Side* side : {&a_, &b_}) {
      if (body.entity == (side == &a_ ? link_a : link_b) && body.meets) {
        side->bodies.push_back(&body);
        const double reach = body.X_LB.translation().norm() + body.middle.norm() + body.radius;
        side->length = std::max(side->length, reach);
      }
    }
  }
  for (Side* side : {&a_, &b_}) {
    side->length += tree.node(side->node).offsets;
    side->level = tree.node(side->node).level + 2;
    side->poses.resize(side->bodies.size());
    side->centers.resize(side->bodies.size());
  }
  ways_.resize(joints_.size());
  findRanges();
}

// A coordinate without limits: turns repeat after a full one, and slides of a single planar or
// floating joint part the links once they exceed all other lengths.
void PairSearch::findRanges() {
  constexpr double kPi = 3.14159265358979323846;
  double lengths = a_.length + b_.length;
  for (const Between& joint : joints_) {
    const std::size_t slot = static_cast<std::size_t>(joint.slot);
    const double low = arm_.tree.lower[coordinates_[slot]],
                 high = arm_.tree.upper[coordinates_[slot]];
    const Joint& given = arm_.tree.node(joint.node).joint;
    if (joint.slides && high < kInfinity) {
      lengths += joint.scale * std::max(std::abs(low), std::abs(high)) +
                 std::abs(given.offset) * arm_.tree.node(joint.node).unit;
    }
  }
  int free_slides = -1;
  double angles = 0, slides = lengths;
  for (std::size_t slot = 0; slot < coordinates_.size(); ++slot) {
    const int k = coordinates_[slot];
    double low = arm_.tree.lower[k], high = arm_.tree.upper[k];
    const double off = std::max(0.0, std::max(low, -high));  // where 0 isn't within
    if (!(low > -kInfinity && high < kInfinity)) {
      int moved = 0;
      const Between* only = nullptr;
      for (const Between& joint : joints_) {
        if (joint.slot != static_cast<int>(slot)) continue;
        ++moved;
        only = &joint;
      }
      double reach = 0;
      if (only->slides) {
        // Slides of one joint are across each other, as their nodes follow one another.
        const int first = only->node;
        bounded_ &= moved == 1 && (free_slides < 0 || first - free_slides <= 2);
        if (free_slides < 0) free_slides = first;
        reach = 2 * lengths * (1 + 0x1p-40);
        slides += reach;
      } else {
        bounded_ &= moved == 1 && only->scale > 0;
        reach = kPi / std::max(only->scale, 1e-3) * (1 + 0x1p-40);
      }
      low = -reach;
      high = reach;
    }
    low_.push_back(low);
    high_.push_back(high);
    for (const Between& joint : joints_) {
      if (joint.slot != static_cast<int>(slot) || joint.slides) continue;
      angles += joint.scale * std::max(std::abs(low), std::abs(high)) +
                std::abs(arm_.tree.node(joint.node).joint.offset) + off;
    }
  }
  pad_ = (0x1p-40 * (a_.level + b_.level) + 0x1p-48 * angles) * (slides + lengths);
  middle_.resize(coordinates_.size());
}

void PairSearch::place(const std::vector<double>& middle) {
  for (const int n : nodes_) {
    const KinematicTree::Node& node = arm_.tree.node(n);
    const PlacedLink& parent = placed_[static_cast<std::size_t>(node.parent)];
    PlacedLink& link = placed_[static_cast<std::size_t>(n)];
    link.R.noalias() = parent.R * node.joint.X_PJ.linear();
    link.t = parent.t + parent.R * node.joint.X_PJ.translation();
    if (node.joint.type == JointType::kFixed) continue;
    const auto slot = std::find(coordinates_.begin(), coordinates_.end(), node.joint.coordinate) -
                      coordinates_.begin();
    const double value =
        (node.joint.multiplier * middle[static_cast<std::size_t>(slot)] + node.joint.offset) *
        node.unit;
    link.axis = link.R * node.axis;
    if (node.joint.type == JointType::kPrismatic) {
      link.t += value * link.axis;
    } else {
      turnAbout(node.axis, value, link.R);
    }
  }
  for (Side* side : {&a_, &b_}) {
    for (std::size_t i = 0; i < side->bodies.size(); ++i) {
      const Body& body = *side->bodies[i];
      side->poses[i] = placed_[static_cast<std::size_t>(side->node)].pose(body.X_LB);
      side->centers[i] = side->poses[i] * body.middle;
    }
  }
}

Eigen::VectorXd PairSearch::configuration() const {
  Eigen::VectorXd q = arm_.tree.lower.cwiseMax(0.0).cwiseMin(arm_.tree.upper);
  for (std::size_t slot = 0; slot < coordinates_.size(); ++slot)
    q[coordinates_[slot]] = middle_[slot];
  return q;
}

/// In contact at what was placed? Then that is the answer, if the robot at large agrees, whose
/// poses are rounded otherwise.
bool PairSearch::touchingAt(LinkPair& result) {
  for (std::size_t i = 0; i < a_.bodies.size(); ++i) {
    for (std::size_t k = 0; k < b_.bodies.size(); ++k) {
      const Body &a = *a_.bodies[i], &b = *b_.bodies[k];
      const double reach = a.radius + b.radius;
      if ((a_.centers[i] - b_.centers[k]).squaredNorm() > reach * reach) continue;
      if (!touching(a, a_.poses[i], b, b_.poses[k], 0)) continue;
      const Eigen::VectorXd q = configuration();
      std::vector<PlacedLink> placed;
      arm_.tree.place(q, placed);
      if (!touching(a, placed[static_cast<std::size_t>(a.node)].pose(a.X_LB), b,
                    placed[static_cast<std::size_t>(b.node)].pose(b.X_LB), 0)) {
        continue;
      }
      result.verdict = PairVerdict::kSometimes;
      result.q = q;
      return true;
    }
  }
  return false;
}

bool PairSearch::sample(LinkPair& result) {
  constexpr int kSamples = 3000;
  std::mt19937_64 random(1);
  std::uniform_real_distribution<double> unit(0, 1);
  bool meets = false, parts = false;
  for (int i = 0; i < kSamples && !(meets && parts); ++i) {
    for (std::size_t k = 0; k < middle_.size(); ++k) {
      const double share = i < 2 ? i : unit(random);  // the corners of all lower, and all upper
      middle_[k] = low_[k] + share * (high_[k] - low_[k]);
    }
    place(middle_);
    (touchingAt(result) ? meets : parts) = true;
  }
  if (!parts) result.verdict = PairVerdict::kAlways;
  return meets;
}

/// Steps at random from configurations in which the pair is near, towards smaller distances.
bool PairSearch::descend(LinkPair& result) {
  constexpr int kStarts = 12, kSteps = 150, kTries = 20;
  std::mt19937_64 random(2);
  std::uniform_real_distribution<double> unit(0, 1);
  const auto distance = [&] {
    double least = kInfinity;
    for (std::size_t i = 0; i < a_.bodies.size(); ++i) {
      for (std::size_t k = 0; k < b_.bodies.size(); ++k) {
        least = std::min(least, distanceOf(*a_.bodies[i], a_.poses[i], *b_.bodies[k], b_.poses[k],
                                           0.05, 0, least)
                                    .distance);
      }
    }
    return least;
  };
  for (int start = 0; start < kStarts; ++start) {
    std::vector<double> best;
    double least = kInfinity;
    const auto offer = [&] {
      place(middle_);
      const double d = distance();
      if (!(d < least)) return false;
      least = d;
      best = middle_;
      return true;
    };
    for (int i = 0; i < kTries; ++i) {
      for (std::size_t k = 0; k < middle_.size(); ++k) {
        middle_[k] = low_[k] + unit(random) * (high_[k] - low_[k]);
      }
      offer();
    }
    double step = 0.2;
    for (int i = 0; i < kSteps && step > 1e-5; ++i) {
      middle_ = best;
      for (std::size_t k = 0; k < middle_.size(); ++k) {
        const double by = step * (2 * unit(random) - 1) * (high_[k] - low_[k]);
        middle_[k] = std::clamp(middle_[k] + by, low_[k], high_[k]);
      }
      step *= offer() ? 1.2 : 0.9;
      if (!(least > 0) && touchingAt(result)) return true;
    }
  }
  return false;
}

double PairSearch::radiusFrom(const Between& joint, const Side& side, std::size_t index) const {
  if (joint.slides) return 1;
  const PlacedLink& link = placed_[static_cast<std::size_t>(joint.node)];
  const Body& body = *side.bodies[index];
  const Vector3d arm = side.centers[index] - link.t, across = link.axis.cross(arm);
  const double by_ball = across.norm() + body.radius;
  const Eigen::Matrix3d& R = side.poses[index].linear();
  const Vector3d x = link.axis.cross(body.half.x() * R.col(0)),
                 y = link.axis.cross(body.half.y() * R.col(1)),
                 z = link.axis.cross(body.half.z() * R.col(2));
  double square = 0;
  for (int corner = 0; corner < 8; ++corner) {
    const Vector3d p = across + ((corner & 1) != 0 ? x : -x) + ((corner & 2) != 0 ? y : -y) +
                       ((corner & 4) != 0 ? z : -z);
    square = std::max(square, p.squaredNorm());
  }
  return std::min(by_ball, std::sqrt(square)) * (1 + 0x1p-30) + pad_;
}

double PairSearch::motionBound(const std::vector<double>& half, std::size_t i, std::size_t k,
                               std::vector<double>& parts) {
  double of_both = 0, of_a = 0, of_b = 0;
  std::vector<double> own(3 * half.size(), 0);
  for (const Between& joint : joints_) {
    const std::size_t slot = static_cast<std::size_t>(joint.slot);
    const double way = joint.scale * half[slot];
    const double a = way * radiusFrom(joint, a_, i), b = way * radiusFrom(joint, b_, k);
    ways_[static_cast<std::size_t>(&joint - joints_.data())] = joint.of_a ? a : b;
    own[3 * slot] += joint.of_a ? a : b;
    own[3 * slot + 1] += a;
    own[3 * slot + 2] += b;
    of_both += joint.of_a ? a : b;
    of_a += a;
    of_b += b;
  }
  const double least = std::min({of_both, of_a, of_b});
  const std::size_t chosen = least == of_both ? 0 : least == of_a ? 1 : 2;
  for (std::size_t slot = 0; slot < half.size(); ++slot) parts[slot] = own[3 * slot + chosen];
  return least * (1 + 0x1p-40) + pad_;
}

bool PairSearch::slabStays(const Vector3d& n, const std::vector<double>& half, std::size_t i,
                           std::size_t k) const {
  const auto extent = [&](const Side& side, std::size_t index) {
    const Vector3d along = side.poses[index].linear().transpose() * n;
    return along.cwiseAbs().dot(side.bodies[index]->half);
  };
  const double gap = std::abs(n.dot(b_.centers[k] - a_.centers[i])) - extent(a_, i) - extent(b_, k);
  if (!(gap > 0)) return false;
  double moved = 0, turned_a = 0, turned_b = 0;
  for (std::size_t j = 0; j < joints_.size(); ++j) {
    const Between& joint = joints_[j];
    const Vector3d& axis = placed_[static_cast<std::size_t>(joint.node)].axis;
    double& turned = joint.of_a ? turned_a : turned_b;
    const double share = joint.slides ? std::abs(n.dot(axis)) : n.cross(axis).norm();
    moved += ways_[j] * std::min(1.0, share + turned + 0x1p-40);
    if (!joint.slides) turned += joint.scale * half[static_cast<std::size_t>(joint.slot)];
  }
  return gap > moved * (1 + 0x1p-40) + pad_;
}

bool PairSearch::anySlabStays(const std::vector<double>& half, std::size_t i, std::size_t k) const {
  if (!(a_.bodies[i]->radius < kInfinity && b_.bodies[k]->radius < kInfinity)) return false;
  for (const Transform3d* X : {&a_.poses[i], &b_.poses[k]}) {
    for (int axis = 0; axis < 3; ++axis) {
      if (slabStays(X->linear().col(axis), half, i, k)) return true;
    }
  }
  return false;
}

bool PairSearch::proveApart(std::size_t i, std::size_t k, long long max_boxes,
                            const std::function<bool()>& late, LinkPair& result) {
  const std::size_t n = coordinates_.size();
  struct Box {
    std::vector<double> low, high;
  };
  std::vector<Box> waiting = {{low_, high_}};
  std::vector<double> half(n), parts(n);
  const Body &a = *a_.bodies[i], &b = *b_.bodies[k];
  while (!waiting.empty()) {
    Box box = std::move(waiting.back());
    waiting.pop_back();
    if (++result.boxes > max_boxes || (result.boxes % 64 == 0 && late())) return false;
    for (std::size_t s = 0; s < n; ++s) {
      middle_[s] = box.low[s] + 0.5 * (box.high[s] - box.low[s]);
      half[s] = std::max(box.high[s] - middle_[s], middle_[s] - box.low[s]) * (1 + 0x1p-50);
    }
    place(middle_);
    const double moved = motionBound(half, i, k, parts);
    const double centers = (a_.centers[i] - b_.centers[k]).norm();
    if (centers - a.radius - b.radius > moved || anySlabStays(half, i, k)) continue;
    if (moved < centers + a.radius + b.radius) {
      // An error that is allowed would be taken off what is proven of a mesh and a shape.
      const double rel_err = a.mesh && b.mesh ? 1 : 0;
      const Nearness near =
          distanceOf(a, a_.poses[i], b, b_.poses[k], rel_err, 0, moved * (1 + 0x1p-30));
      if (near.lower > moved) continue;
      if (!(near.distance > 0) && touchingAt(result)) return false;
    }
    std::size_t widest = 0;
    for (std::size_t s = 1; s < n; ++s) {
      if (parts[s] > parts[widest]) widest = s;
    }
    // Nothing is left to be split: doubles end here, or no joint moves the pair.
    if (n == 0 || !(box.low[widest] < middle_[widest] && middle_[widest] < box.high[widest])) {
      return false;
    }
    Box upper = box;
    upper.low[widest] = box.high[widest] = middle_[widest];
    waiting.push_back(std::move(upper));
    waiting.push_back(std::move(box));
  }
  return true;
}

bool PairSearch::look(LinkPair& result) {
  result.verdict = PairVerdict::kOpen;
  if (!coordinates_.empty()) return sample(result) || descend(result);
  place(middle_);
  if (!touchingAt(result)) return false;
  result.verdict = PairVerdict::kAlways;
  return true;
}

void PairSearch::prove(long long max_boxes, const std::function<bool()>& late, LinkPair& result) {
  bool apart = bounded_;
  result.boxes = 0;
  for (std::size_t i = 0; i < a_.bodies.size() && apart; ++i) {
    for (std::size_t k = 0; k < b_.bodies.size() && apart; ++k) {
      apart = proveApart(i, k, max_boxes, late, result);
    }
  }
  if (apart) result.verdict = PairVerdict::kNever;
}

}  // namespace kios::robot
