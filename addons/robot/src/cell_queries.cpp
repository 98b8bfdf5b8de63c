// SPDX-FileCopyrightText: 2026 The fcl_kios authors
// SPDX-License-Identifier: BSD-3-Clause
//
// What is asked of a robot at one configuration.

#include <algorithm>
#include <cmath>
#include <utility>

#include "cell.h"
#include "pair_query.h"
#include "volume/ball_lanes.h"
#include "volume/rounding.h"

namespace kios::robot {
namespace {

using fcl::Transform3d;
using fcl::Vector3d;

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
    const std::size_t count = cell.carried_.size();
    placed.poses.resize(count);
    placed.posed.assign(count, 0);
    placed.centers.resize(count);
    for (std::size_t i = 0; i < count; ++i) {
      const Body& body = cell.bodies_[cell.carried_[i]];
      const PlacedLink& link = placed.links[body.node];
      placed.centers[i] = link.place(body.X_LB.translation()) + link.R * body.middle_L;
    }
    placed.found.clear();
    return placed;
  }
  const Transform3d& pose(int id) const {
    const Body& body = cell->bodies_[id];
    if (body.node < 0) return body.X_LB;
    if (posed[body.place] == 0) {
      posed[body.place] = 1;
      poses[body.place] = links[body.node].pose(body.X_LB);
    }
    return poses[body.place];
  }
  const Vector3d& center(int id) const {
    const Body& body = cell->bodies_[id];
    return body.node < 0 ? body.center : centers[body.place];
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
  for (const int a : carried_) {
    const Body& body = bodies_[a];
    const Vector3d& center = placed.centers[body.place];
    const double reach = body.radius + body.padding;
    const auto meets = [&](int first, int second, int other) {
      found = {first, second};
      return isChecked(body, bodies_[other]) && touch(placed, first, second, nullptr);
    };
    const auto carried = [&](std::size_t place) {
      return meets(carried_[place], a, carried_[place]);
    };
    const auto obstacle = [&](std::size_t place) {
      return meets(a, obstacles_[place], obstacles_[place]);
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
  contact.a = entities_[a.entity].name;
  contact.b = entities_[b.entity].name;
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
  const auto add = [&](int a, int b) {
    const Body &first = bodies_[a], &second = bodies_[b];
    if (!isChecked(first, second)) return;
    const double bound = boundOf(placed, a, b) - (first.padding + second.padding);
    if (bound <= within) found.push_back({bound, a, b});
  };
  for (std::size_t place = 0; place < carried_.size(); ++place) {
    for (std::size_t i = 0; among != RobotPairs::kObstacles && i < place; ++i) {
      add(carried_[i], carried_[place]);
    }
    if (among == RobotPairs::kItself) continue;
    for (const int obstacle : obstacles_) add(carried_[place], obstacle);
  }
}

RobotClearance Cell::answer(const Placed& placed, const Candidate& pair, const Nearness& near,
                            bool gradient) const {
  const Body &a = bodies_[pair.a], &b = bodies_[pair.b];
  RobotClearance result;
  Nearness exact = near;
  if (gradient) addGradient(placed, a, b, exact, result);
  result.a = entities_[a.entity].name;
  result.b = entities_[b.entity].name;
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

RobotClearance Cell::clearance(const Eigen::VectorXd& q, const ClearanceRequest& options) const {
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
