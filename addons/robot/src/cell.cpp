// SPDX-FileCopyrightText: 2026 The fcl_kios authors
// SPDX-License-Identifier: BSD-3-Clause
#include "cell.h"

#include <algorithm>
#include <utility>

#include "text_file.h"

namespace kios::robot {

Cell::Cell(std::shared_ptr<const Arm> arm, const std::vector<Object>& objects,
           const std::set<NamePair>& allowed, const std::map<std::string, double>& paddings)
    : arm_(std::move(arm)), names_(arm_->links), bodies_(arm_->bodies) {
  for (const bool attached : {true, false}) {
    if (!attached) carried_ = static_cast<int>(bodies_.size());
    for (const Object& object : objects) {
      if ((object.link >= 0) != attached) continue;
      const int entity = static_cast<int>(names_.size());
      names_.push_back(object.name);
      for (std::size_t i = 0; i < object.elements.size(); ++i) {
        Body body;
        body.geometry = object.elements[i].geometry;
        body.entity = entity;
        body.element = static_cast<int>(i);
        body.node = attached ? arm_->tree.nodeOf(object.link) : -1;
        body.X_LB = rigidProduct(object.X, object.elements[i].X);
        body.measure();
        bodies_.push_back(std::move(body));
      }
    }
  }
  for (Body& body : bodies_) {
    const auto padding = paddings.find(names_[body.entity]);
    if (padding != paddings.end()) body.padding = padding->second;
  }
  const int count = static_cast<int>(bodies_.size());
  among_.resize(static_cast<std::size_t>(carried_));
  around_.resize(static_cast<std::size_t>(carried_));
  checked_.assign(static_cast<std::size_t>(carried_) * bodies_.size(), 0);
  for (int b = carried_; b < count; ++b) {
    const Body& body = bodies_[b];
    middles_.push_back(body.X_LB * body.middle);
    boxes_.add(body.X_LB, body.middle, body.half, body.padding);
  }
  for (int a = 0; a < carried_; ++a) {
    for (int b = 0; b < count; ++b) {
      if (b >= a && b < carried_) continue;
      if (!checked(bodies_[a], bodies_[b], allowed)) continue;
      checked_[static_cast<std::size_t>(a) * bodies_.size() + static_cast<std::size_t>(b)] = 1;
      (b < a ? among_ : around_)[static_cast<std::size_t>(a)].push_back(b);
    }
  }
  addProofs();
}

bool Cell::checked(const Body& a, const Body& b, const std::set<NamePair>& allowed) const {
  if (!a.meets || !b.meets || a.node == b.node) return false;
  return allowed.count(namePair(names_[a.entity], names_[b.entity])) == 0;
}

// A linkage asks for one separation of all its pairs, so that there is one for each sum of paddings
// that occurs, in which the pairs of others are allowed.
void Cell::addProofs() {
  std::map<double, std::vector<Pair>> classes;
  for (int a = 0; a < carried_; ++a) {
    const auto add = [&](int b) {
      classes[bodies_[a].padding + bodies_[b].padding].push_back({std::min(a, b), std::max(a, b)});
    };
    std::for_each(among_[a].begin(), among_[a].end(), add);
    std::for_each(around_[a].begin(), around_[a].end(), add);
  }
  if (classes.empty()) classes[0];
  const auto num_links = static_cast<int>(arm_->bodies.size());
  const int count = static_cast<int>(bodies_.size());
  Linkage all = arm_->linkage;
  for (int b = num_links; b < count; ++b)
    all.addBody(bodies_[b].node, bodies_[b].geometry, bodies_[b].X_LB);
  std::vector<char> wanted;
  for (const auto& [separation, pairs] : classes) {
    proofs_.push_back({separation, all});
    Linkage& linkage = proofs_.back().linkage;
    wanted.assign(static_cast<std::size_t>(carried_) * static_cast<std::size_t>(count), 0);
    const auto at = [&](int a, int b) -> char& {
      return wanted[static_cast<std::size_t>(a) * static_cast<std::size_t>(count) +
                    static_cast<std::size_t>(b)];
    };
    for (const Pair& pair : pairs) at(pair.a, pair.b) = 1;
    for (int a = 0; a < carried_; ++a) {
      for (int b = a + 1; b < count; ++b) {
        if (at(a, b) == 0) linkage.allow(a, b);
      }
    }
  }
}

RobotMotion Cell::checkMotion(const std::vector<Proof>& proofs, const Eigen::VectorXd& q0,
                              const Eigen::VectorXd& q1, const MotionRequest& request) const {
  const auto isEarlier = [](const MotionAnswer& a, const MotionAnswer& b) {
    return std::make_pair(a.from, a.to) < std::make_pair(b.from, b.to);
  };
  RobotMotion result;
  MotionCounts counts;
  for (const Proof& proof : proofs) {
    MotionRequest padded = request;
    padded.min_separation += proof.separation;
    const MotionAnswer answer = kios::checkMotion(proof.linkage, q0, q1, padded);
    counts.configurations += answer.counts.configurations;
    counts.pairs += answer.counts.pairs;
    counts.proven_at_once += answer.counts.proven_at_once;
    counts.queries += answer.counts.queries;
    counts.narrow_queries += answer.counts.narrow_queries;
    counts.expansions += answer.counts.expansions;
    const bool contact = answer.verdict == MotionVerdict::kContact;
    if (answer.verdict == MotionVerdict::kClear) continue;
    const bool first = result.verdict == MotionVerdict::kClear;
    const bool better = request.first_contact
                            ? isEarlier(answer, result)
                            : contact && result.verdict != MotionVerdict::kContact;
    if (first || better) static_cast<MotionAnswer&>(result) = answer;
    if (contact && !request.first_contact) break;
  }
  result.counts = counts;
  if (result.body_a >= 0) {
    result.a = names_[bodies_[result.body_a].entity];
    result.b = names_[bodies_[result.body_b].entity];
  }
  return result;
}

}  // namespace kios::robot
