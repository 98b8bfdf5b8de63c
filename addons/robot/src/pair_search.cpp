// SPDX-FileCopyrightText: 2026 The fcl_kios authors
// SPDX-License-Identifier: BSD-3-Clause
#include "pair_search.h"

#include <algorithm>
#include <cmath>
#include <random>

#include "pair_query.h"
#include "volume/rounding.h"

namespace kios::robot {

using Eigen::VectorXd;

PairSearch::PairSearch(const Arm& arm)
    : arm_(arm), low_(arm.tree.lower), high_(arm.tree.upper), bodies_(arm.links.size()) {
  const KinematicTree& tree = arm.tree;
  // Coordinates without limits turn, or are the slides of a planar or floating joint, which are
  // across each other: they part all links once one exceeds all other lengths.
  double body = 0, lengths = 0;
  for (const Body& b : arm.bodies) {
    if (b.meets) bodies_[static_cast<std::size_t>(b.entity)].push_back(&b);
    body = std::max(body, b.X_LB.translation().norm() + b.middle.norm() + b.radius);
  }
  for (std::size_t n = 0; n < tree.size(); ++n) {
    const Joint& joint = tree.node(static_cast<int>(n)).joint;
    lengths += joint.X_PJ.translation().norm();
    if (joint.type != JointType::kPrismatic || !(high_[joint.coordinate] < kInfinity)) continue;
    const double most =
        std::max(std::abs(low_[joint.coordinate]), std::abs(high_[joint.coordinate]));
    lengths += std::abs(joint.multiplier) * most + std::abs(joint.offset);
  }
  for (std::size_t n = 0; n < tree.size(); ++n) {
    const Joint& joint = tree.node(static_cast<int>(n)).joint;
    if (joint.type == JointType::kFixed || high_[joint.coordinate] < kInfinity) continue;
    constexpr double kHalfTurn = 3.15;
    high_[joint.coordinate] =
        joint.type == JointType::kPrismatic ? 2 * (lengths + 2 * body) : kHalfTurn;
    low_[joint.coordinate] = -high_[joint.coordinate];
  }
  constexpr int kSamples = 3000;
  std::mt19937_64 random(1);
  std::uniform_real_distribution<double> unit(0, 1);
  placed_.resize(kSamples);
  for (std::size_t i = 0; i < placed_.size(); ++i) {
    VectorXd q = i == 0 ? low_ : high_;
    for (Eigen::Index k = 0; i > 1 && k < q.size(); ++k) {
      q[k] = low_[k] + unit(random) * (high_[k] - low_[k]);
    }
    tree.place(q, placed_[i]);
    samples_.push_back(std::move(q));
  }
}

PairSearch::Between PairSearch::between(int link_a, int link_b) const {
  const KinematicTree& tree = arm_.tree;
  std::vector<char> sides(tree.size(), 0);  // that a node is above
  for (const int link : {link_a, link_b}) {
    for (int n = tree.nodeOf(link); n >= 0; n = tree.parent(n)) {
      ++sides[static_cast<std::size_t>(n)];
    }
  }
  Between result;
  std::vector<int> number(tree.size(), -1), free_slides;
  for (std::size_t n = 0; n < tree.size(); ++n) {
    if (sides[n] != 1) continue;
    Joint joint = tree.node(static_cast<int>(n)).joint;
    const int k = joint.coordinate, parent = tree.parent(static_cast<int>(n));
    if (joint.type != JointType::kFixed) {
      auto& known = result.coordinates;
      const auto at = std::find(known.begin(), known.end(), k);
      joint.coordinate = static_cast<int>(at - known.begin());
      const bool limited = tree.upper[k] < kInfinity;
      const bool slides = joint.type == JointType::kPrismatic;
      if (at == known.end()) {
        known.push_back(k);
        result.box.lower.push_back(slides ? low_[k] : tree.lower[k]);
        result.box.upper.push_back(slides ? high_[k] : tree.upper[k]);
        if (slides && !limited) free_slides.push_back(k);
      } else if (!limited) {
        result.bounded = false;
      }
    }
    number[n] = result.linkage.addLink(number[static_cast<std::size_t>(parent)], joint);
  }
  // Those of one joint follow one another.
  result.bounded &= free_slides.empty() || free_slides.back() - free_slides.front() <= 2;
  for (const int link : {link_a, link_b}) {
    for (const Body* body : bodies_[static_cast<std::size_t>(link)]) {
      result.linkage.addBody(number[static_cast<std::size_t>(body->node)], arm_.linkage,
                             static_cast<int>(body - arm_.bodies.data()), body->X_LB);
    }
  }
  return result;
}

bool PairSearch::touch(int link_a, int link_b, const std::vector<PlacedLink>& placed) const {
  for (const Body* a : bodies_[static_cast<std::size_t>(link_a)]) {
    const PlacedLink& on_a = placed[static_cast<std::size_t>(a->node)];
    const Eigen::Vector3d center = on_a.place(a->X_LB.translation() + a->middle_L);
    for (const Body* b : bodies_[static_cast<std::size_t>(link_b)]) {
      const PlacedLink& on_b = placed[static_cast<std::size_t>(b->node)];
      const double reach = a->radius + b->radius;
      const Eigen::Vector3d apart = center - on_b.place(b->X_LB.translation() + b->middle_L);
      if (apart.squaredNorm() > reach * reach) continue;
      if (touching(*a, on_a.pose(a->X_LB), *b, on_b.pose(b->X_LB), 0)) return true;
    }
  }
  return false;
}

void PairSearch::sample(int link_a, int link_b, LinkPair& result) const {
  const bool moves = !between(link_a, link_b).coordinates.empty();
  const std::size_t count = moves ? placed_.size() : 1;
  bool meets = false, parts = false;
  for (std::size_t i = 0; i < count && !(meets && parts); ++i) {
    const bool contact = touch(link_a, link_b, placed_[i]);
    if (contact && !meets) result.q = samples_[i];
    (contact ? meets : parts) = true;
  }
  if (meets) result.verdict = parts ? PairVerdict::kSometimes : PairVerdict::kAlways;
}

void PairSearch::touchAt(const RangeResult& found, const Between& between, int link_a, int link_b,
                         LinkPair& result) const {
  if (found.at.empty() || found.upper > 0) return;
  VectorXd q = arm_.tree.lower.cwiseMax(0.0).cwiseMin(arm_.tree.upper);
  for (std::size_t k = 0; k < found.at.size(); ++k) q[between.coordinates[k]] = found.at[k];
  std::vector<PlacedLink> placed;
  arm_.tree.place(q, placed);
  if (!touch(link_a, link_b, placed)) return;  // the linkage's poses are rounded otherwise
  result.verdict = PairVerdict::kSometimes;
  result.q = q;
}

void PairSearch::look(int link_a, int link_b, LinkPair& result) const {
  constexpr int kBoxes = 80;
  RangeRequest request;
  request.rel_err = 0.5;
  request.max_queries = 50;
  const Between between = this->between(link_a, link_b);
  const std::size_t size = between.coordinates.size();
  for (int i = 2; i < 2 + kBoxes && result.verdict == PairVerdict::kOpen; ++i) {
    JointBox box = between.box;
    for (std::size_t k = 0; k < size; ++k) {
      const int of = between.coordinates[k];
      const double middle = samples_[static_cast<std::size_t>(i)][of];
      const double half = 0.5 * (high_[of] - low_[of]);
      box.lower[k] = std::max(low_[of], middle - half);
      box.upper[k] = std::min(high_[of], middle + half);
    }
    touchAt(leastClearance(between.linkage, box, request), between, link_a, link_b, result);
  }
}

void PairSearch::prove(int link_a, int link_b, long long max_queries, LinkPair& result) const {
  const Between between = this->between(link_a, link_b);
  if (!between.bounded) return;
  RangeRequest request;
  request.abs_err = request.rel_err = 0;
  request.ceiling = 0x1p-500;  // any distance will do
  request.max_queries = max_queries;
  const RangeResult found = leastClearance(between.linkage, between.box, request);
  result.boxes = found.queries;
  if (found.lower > 0) result.verdict = PairVerdict::kNever;
  touchAt(found, between, link_a, link_b, result);
}

}  // namespace kios::robot
