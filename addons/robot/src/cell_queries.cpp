// SPDX-FileCopyrightText: 2026 The fcl_kios authors
// SPDX-License-Identifier: BSD-3-Clause
//
// What is asked of a robot at one configuration.

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

#include "cell.h"
#include "pair_query.h"
#include "volume/ball_lanes.h"

namespace kios::robot {
namespace {

using fcl::Transform3d;
using fcl::Vector3d;

constexpr double kInfinity = std::numeric_limits<double>::infinity();

}  // namespace

/// All bodies at a configuration. Its memory is the thread's, for the next query.
struct Cell::Placed {
  const Cell* cell = nullptr;
  std::vector<PlacedLink> links;
  std::vector<Vector3d> centers;  ///< of what links carry, as `poses`
  mutable std::vector<Transform3d> poses;
  mutable std::vector<char> posed;  ///< the pose was asked for and is set
  std::vector<Candidate> found;
  BallLanes balls;

  static Placed& of(const Cell& cell, const Eigen::VectorXd& q) {
    static thread_local Placed placed;
    placed.cell = &cell;
    cell.arm_->tree.place(q, placed.links);
    const auto count = static_cast<std::size_t>(cell.carried_);
    placed.poses.resize(count);
    placed.posed.assign(count, 0);
    placed.centers.resize(count);
    for (std::size_t i = 0; i < count; ++i) {
      const Body& body = cell.bodies_[i];
      const PlacedLink& link = placed.links[body.node];
      placed.centers[i] = link.place(body.X_LB.translation()) + link.R * body.middle_L;
    }
    placed.found.clear();
    return placed;
  }
  const Transform3d& pose(int i) const {
    const Body& body = cell->bodies_[i];
    if (i >= cell->carried_) return body.X_LB;
    if (posed[i] == 0) {
      posed[i] = 1;
      poses[i] = links[body.node].pose(body.X_LB);
    }
    return poses[i];
  }
  const Vector3d& center(int i) const {
    return i < cell->carried_ ? centers[i] : cell->middles_[i - cell->carried_];
  }
};

double Cell::ballToBox(const Placed& placed, int a, int b) const {
  const Body& box = bodies_[b];
  const Vector3d p = placed.pose(b).linear().transpose() * (placed.center(a) - placed.center(b));
  const Vector3d out = (p.cwiseAbs() - box.half).cwiseMax(0.0);
  return out.norm() - bodies_[a].radius;
}

// Centres and boxes round by 2^-50 of their coordinates.
double Cell::boundOf(const Placed& placed, int a, int b) const {
  const Vector3d d = placed.center(a) - placed.center(b);
  double bound = std::max(ballToBox(placed, a, b), ballToBox(placed, b, a));
  bound = std::max(bound, d.norm() - bodies_[a].radius - bodies_[b].radius);
  bound -= 0x1p-45 * (placed.center(a).lpNorm<1>() + placed.center(b).lpNorm<1>());
  // A half-space is without bounds, of which NaN may be left.
  return bound > 0 ? bound : 0;
}

bool Cell::touch(const Placed& placed, int a, int b, RobotContact* contact) const {
  const Body &first = bodies_[a], &second = bodies_[b];
  const double separation = first.padding + second.padding;
  return (contact || boundOf(placed, a, b) <= separation) &&
         touching(first, placed.pose(a), second, placed.pose(b), separation, contact);
}

bool Cell::findContact(Placed& placed, Pair& found) const {
  placed.balls.clear();
  for (int a = 0; a < carried_; ++a) {
    const Vector3d& center = placed.centers[a];
    const double reach = bodies_[a].radius + bodies_[a].padding;
    const auto carried = [&](std::size_t other) {
      found = {static_cast<int>(other), a};
      return isChecked(a, found.a) && touch(placed, found.a, found.b, nullptr);
    };
    const auto obstacle = [&](std::size_t other) {
      found = {a, carried_ + static_cast<int>(other)};
      return isChecked(a, found.b) && touch(placed, found.a, found.b, nullptr);
    };
    if (placed.balls.add(center, reach, carried)) return true;
    if (boxes_.forNear(center, reach, obstacle)) return true;
  }
  return false;
}

std::optional<RobotContact> Cell::contact(const Eigen::VectorXd& q) const {
  Placed& placed = Placed::of(*this, q);
  Pair found{};
  RobotContact contact;
  if (!findContact(placed, found)) return std::nullopt;
  // Asked for its point, FCL may deny a contact of two shapes that barely touch.
  touch(placed, found.a, found.b, &contact);
  const Body &a = bodies_[found.a], &b = bodies_[found.b];
  contact.a = names_[a.entity];
  contact.b = names_[b.entity];
  contact.element_a = a.element;
  contact.element_b = b.element;
  return contact;
}

bool Cell::inContact(const Eigen::VectorXd& q) const {
  Pair found{};
  return findContact(Placed::of(*this, q), found);
}

void Cell::candidates(const Placed& placed, double within, RobotPairs among,
                      std::vector<Candidate>& found) const {
  for (int a = 0; a < carried_; ++a) {
    for (const auto* others : {&among_[a], &around_[a]}) {
      const bool obstacles = others == &around_[a];
      if (among == (obstacles ? RobotPairs::kItself : RobotPairs::kObstacles)) continue;
      for (const int other : *others) {
        const int i = std::min(a, other), j = std::max(a, other);
        const double bound = boundOf(placed, i, j) - (bodies_[i].padding + bodies_[j].padding);
        if (bound <= within) found.push_back({bound, i, j});
      }
    }
  }
}

RobotClearance Cell::answer(const Placed& placed, const Candidate& pair, const Nearness& near,
                            bool gradient) const {
  const Body &a = bodies_[pair.a], &b = bodies_[pair.b];
  RobotClearance result;
  Nearness exact = near;
  if (gradient) addGradient(placed, a, b, exact, result);
  result.a = names_[a.entity];
  result.b = names_[b.entity];
  result.element_a = a.element;
  result.element_b = b.element;
  const double padding = a.padding + b.padding;
  result.clearance = near.distance - padding;
  result.lower_bound = near.lower - padding;
  result.point_a = exact.point_a;
  result.point_b = exact.point_b;
  result.id_a = near.id_a;
  result.id_b = near.id_b;
  return result;
}

void Cell::addGradient(const Placed& placed, const Body& a, const Body& b, Nearness& near,
                       RobotClearance& answer) const {
  answer.gradient = UnalignedVector::Zero(arm_->tree.coordinates());
  const auto poseOf = [&](const Body& body) -> const Transform3d& {
    return placed.pose(static_cast<int>(&body - bodies_.data()));
  };
  Vector3d n = near.point_b - near.point_a;
  const double length = n.norm();
  if (near.distance > 0 && length > 0) {
    n /= length;
  } else {
    n = wayOut(a, poseOf(a), b, poseOf(b), near);
  }
  const KinematicTree& tree = arm_->tree;
  if (b.node >= 0) tree.addGradient(b.node, near.point_b, n, 1, placed.links, answer.gradient);
  if (a.node >= 0) tree.addGradient(a.node, near.point_a, n, -1, placed.links, answer.gradient);
}

RobotClearance Cell::clearance(const Eigen::VectorXd& q, const ClearanceOptions& options) const {
  Placed& placed = Placed::of(*this, q);
  std::vector<Candidate>& waiting = placed.found;
  candidates(placed, kInfinity, options.among, waiting);
  std::make_heap(waiting.begin(), waiting.end());
  RobotClearance best;
  Nearness nearest;
  Candidate pair = {kInfinity, -1, -1};
  double least = kInfinity, lower = kInfinity;  // clearance, and the bound of all pairs
  while (!waiting.empty()) {
    const double enough = std::min(least, options.far_enough);
    const Candidate next = waiting.front();
    if (next.bound >= enough) {
      lower = std::min(lower, next.bound);
      break;
    }
    std::pop_heap(waiting.begin(), waiting.end());
    waiting.pop_back();
    const Body &a = bodies_[next.a], &b = bodies_[next.b];
    const double padding = a.padding + b.padding;
    const Nearness near =
        distanceOf(a, placed.pose(next.a), b, placed.pose(next.b), options.rel_err, options.abs_err,
                   enough < kInfinity ? enough + padding : enough);
    lower = std::min(lower, near.lower - padding);
    if (near.distance - padding < least && near.distance < kInfinity) {
      least = near.distance - padding;
      nearest = near;
      pair = next;
    }
    if (options.rel_err == 0 && options.abs_err == 0 && !(near.distance > 0) &&
        (waiting.empty() || !(waiting.front().bound < least))) {
      break;
    }
  }
  if (pair.a >= 0) best = answer(placed, pair, nearest, options.gradient);
  best.lower_bound = std::min(lower, best.clearance);
  return best;
}

std::vector<RobotClearance> Cell::clearances(const Eigen::VectorXd& q, double within) const {
  Placed& placed = Placed::of(*this, q);
  candidates(placed, within, RobotPairs::kAll, placed.found);
  struct Found {
    Candidate pair;
    Nearness near;
    double clearance;
  };
  std::map<std::pair<int, int>, Found> least;  // by entities
  for (const Candidate& pair : placed.found) {
    const Body &a = bodies_[pair.a], &b = bodies_[pair.b];
    const double padding = a.padding + b.padding;
    const std::pair<int, int> key(a.entity, b.entity);
    const auto known = least.find(key);
    const double enough = known == least.end() ? within : known->second.clearance;
    if (pair.bound > enough) continue;
    // What is as far as `within` counts, so that the threshold lies above it.
    const double far = enough < kInfinity ? (enough + padding) * (1 + 0x1p-40) + 0x1p-500 : enough;
    const Nearness near = distanceOf(a, placed.pose(pair.a), b, placed.pose(pair.b), 0, 0, far);
    const double clearance = near.distance - padding;
    if (!(clearance <= within)) continue;
    if (known == least.end()) {
      least.emplace(key, Found{pair, near, clearance});
    } else if (clearance < known->second.clearance) {
      known->second = {pair, near, clearance};
    }
  }
  std::vector<RobotClearance> result;
  result.reserve(least.size());
  for (const auto& [key, found] : least) {
    result.push_back(answer(placed, found.pair, found.near, true));
  }
  std::stable_sort(result.begin(), result.end(),
                   [](const auto& a, const auto& b) { return a.clearance < b.clearance; });
  return result;
}

}  // namespace kios::robot
