// SPDX-FileCopyrightText: 2026 The fcl_kios authors
// SPDX-License-Identifier: BSD-3-Clause
#include "cell.h"

#include <algorithm>
#include <limits>
#include <tuple>
#include <utility>

#include "text_file.h"

namespace kios::robot {

Cell::Cell(std::shared_ptr<const Arm> arm, const std::vector<Entity>& links)
    : arm_(std::move(arm)), num_link_bodies_(static_cast<int>(arm_->bodies.size())) {
  for (std::size_t i = 0; i < links.size(); ++i) set(static_cast<int>(i), links[i]);
  bodies_ = arm_->bodies;
  for (int i = 0; i < num_link_bodies_; ++i) {
    bodies_[i].padding = entities_[bodies_[i].entity].padding;
    list(i);
  }
  checkCarried();
  for (int b = 0; b < num_link_bodies_; ++b) {
    for (int a = 0; a < b; ++a) {
      const int proof = proofOf(a, b);
      if (proof >= 0) ++proofs_[proof].pairs;
    }
  }
  settle();
}

void Cell::set(int entity, Entity who) {
  const auto index = static_cast<std::size_t>(entity);
  if (index >= entities_.size()) {
    entities_.resize(index + 1);
    bodies_of_.resize(index + 1);
    orders_.resize(index + 1);
  }
  const auto at = [&](int other) -> std::vector<int>& { return entities_[other].ignored; };
  for (const int other : entities_[index].ignored) {
    at(other).erase(std::lower_bound(at(other).begin(), at(other).end(), entity));
  }
  entities_[index] = std::move(who);
  for (const int other : entities_[index].ignored) {
    if (static_cast<std::size_t>(other) >= entities_.size()) continue;  // a link yet to come
    const auto place = std::lower_bound(at(other).begin(), at(other).end(), entity);
    if (place == at(other).end() || *place != entity) at(other).insert(place, entity);
  }
}

void Cell::list(int id) {
  Body& body = bodies_[id];
  std::vector<int>& like = body.node < 0 ? obstacles_ : carried_;
  body.place = static_cast<int>(like.size());
  like.push_back(id);
  if (body.node >= 0) return;
  boxes_.set(static_cast<std::size_t>(body.place), body.X_LB, body.center, body.half, body.padding);
}

// The last obstacle takes the place; links come first among what is carried.
void Cell::unlist(int id) {
  const Body& body = bodies_[id];
  if (body.node >= 0) {
    carried_.erase(carried_.begin() + body.place);
    for (std::size_t i = 0; i < carried_.size(); ++i) {
      bodies_[carried_[i]].place = static_cast<int>(i);
    }
    return;
  }
  const int place = body.place;
  Body& last = bodies_[obstacles_.back()];
  obstacles_[place] = obstacles_.back();
  last.place = place;
  boxes_.set(static_cast<std::size_t>(place), last.X_LB, last.center, last.half, last.padding);
  boxes_.removeLast();
  obstacles_.pop_back();
}

void Cell::put(int entity, const Object& object) {
  orders_[entity] = object.order;
  const int node = object.link >= 0 ? arm_->tree.nodeOf(object.link) : -1;
  for (const int id : bodies_of_[entity]) {
    Body& body = bodies_[id];
    body.padding = entities_[entity].padding;
    body.put(node, rigidProduct(object.X, object.elements[body.element].X));
    list(id);
  }
  if (node >= 0) checkCarried();
  for (const int id : bodies_of_[entity]) countPairs(id, 1);
  for (const int id : bodies_of_[entity]) enterProofs(id);
  settle();
}

void Cell::withdraw(int entity) {
  bool carried = false;
  for (const int id : bodies_of_[entity]) countPairs(id, -1);
  for (const int id : bodies_of_[entity]) {
    carried |= bodies_[id].node >= 0;
    unlist(id);
  }
  if (carried) checkCarried();
}

void Cell::come(int entity, Entity who, const Object& object) {
  set(entity, std::move(who));
  for (std::size_t i = 0; i < object.elements.size(); ++i) {
    Body body;
    body.geometry = object.elements[i].geometry;
    body.measured = object.elements[i].measured;
    body.entity = entity;
    body.element = static_cast<int>(i);
    body.measure();
    if (free_.empty()) {
      bodies_.emplace_back();
      free_.push_back(static_cast<int>(bodies_.size()) - 1);
    }
    bodies_of_[entity].push_back(free_.back());
    bodies_[free_.back()] = std::move(body);
    free_.pop_back();
  }
  put(entity, object);
}

void Cell::go(int entity) {
  withdraw(entity);
  for (const int id : bodies_of_[entity]) {
    for (std::size_t k = 0; k < bodies_[id].numbers.size(); ++k) {
      const int number = bodies_[id].numbers[k];
      if (number >= 0) proofs_[k].linkage.removeBody(number);
    }
    bodies_[id] = Body();
    free_.push_back(id);
  }
  bodies_of_[entity].clear();
  set(entity, {});
  settle();
}

void Cell::change(int entity, Entity who, const Object& object) {
  withdraw(entity);
  set(entity, std::move(who));
  put(entity, object);
}

void Cell::move(int entity, const Object& object) {
  for (const int id : bodies_of_[entity]) {
    Body& body = bodies_[id];
    body.put(-1, rigidProduct(object.X, object.elements[body.element].X));
    boxes_.set(static_cast<std::size_t>(body.place), body.X_LB, body.center, body.half,
               body.padding);
    for (std::size_t k = 0; k < body.numbers.size(); ++k) {
      if (body.numbers[k] >= 0) proofs_[k].linkage.moveBody(body.numbers[k], body.X_LB);
    }
  }
}

void Cell::checkCarried() {
  checked_.clear();
  for (const int a : carried_) {
    for (const int b : carried_) checked_.push_back(checked(bodies_[a], bodies_[b]) ? 1 : 0);
  }
}

template <typename Visit>
void Cell::forOthers(int id, const Visit& visit) const {
  for (const int other : carried_) {
    if (other != id) visit(other);
  }
  if (bodies_[id].node < 0) return;
  for (const int other : obstacles_) visit(other);
}

// A linkage asks for one separation of all its pairs, so that there is one for each sum of paddings
// that occurs, in which the pairs of others are ignored. It has all links, and of objects those of
// which a pair has its sum.
int Cell::proofOf(int a, int b) {
  const Body &first = bodies_[a], &second = bodies_[b];
  const bool carried = first.node >= 0;
  if (!isChecked(carried ? first : second, carried ? second : first)) return -1;
  const double sum = first.padding + second.padding;
  int free = -1;
  for (std::size_t k = 0; k < proofs_.size(); ++k) {
    if (proofs_[k].separation == sum && proofs_[k].pairs >= 0) return static_cast<int>(k);
    if (proofs_[k].pairs < 0) free = static_cast<int>(k);
  }
  if (free < 0) {
    free = static_cast<int>(proofs_.size());
    proofs_.emplace_back();
  }
  Proof& made = proofs_[free];
  made = {sum, arm_->linkage, {}, 0};
  for (int i = 0; i < num_link_bodies_; ++i) {
    made.bodies.push_back(i);
    for (int k = 0; k < i; ++k) {
      const Body &x = bodies_[k], &y = bodies_[i];
      if (!checked(x, y) || x.padding + y.padding != sum) made.linkage.ignorePair(k, i);
    }
  }
  return free;
}

void Cell::countPairs(int id, int sign) {
  forOthers(id, [&](int other) {
    const int proof = proofOf(id, other);
    if (proof >= 0) proofs_[proof].pairs += sign;
  });
}

void Cell::enterProofs(int id) {
  std::vector<char> any(proofs_.size(), 0);
  std::vector<std::pair<int, int>> others;  // and the proofs of the pairs
  forOthers(id, [&](int other) {
    others.emplace_back(other, proofOf(id, other));
    if (others.back().second >= 0) any[others.back().second] = 1;
  });
  bodies_[id].numbers.resize(proofs_.size(), -1);
  for (std::size_t k = 0; k < proofs_.size(); ++k) {
    Body& body = bodies_[id];
    Proof& proof = proofs_[k];
    int& number = body.numbers[k];
    if (any[k] == 0) {
      if (number >= 0) proof.linkage.removeBody(number);
      number = -1;
      continue;
    }
    if (number >= 0) {
      proof.linkage.moveBody(number, body.node, body.X_LB);
    } else {
      number = proof.linkage.addBody(body.node, *body.measured, 0, body.X_LB);
      proof.bodies.resize(
          std::max(proof.bodies.size(), static_cast<std::size_t>(proof.linkage.bodies())), -1);
      proof.bodies[number] = id;
    }
    const int own = number;
    for (const auto& [other, of_pair] : others) {
      const bool wanted = of_pair == static_cast<int>(k);
      const int theirs = numberIn(static_cast<int>(k), other);
      if (theirs >= 0) {
        proof.linkage.ignorePair(own, theirs, !wanted);
      } else if (wanted) {
        enterProofs(other);
      }
    }
  }
}

void Cell::settle() {
  ascending_.clear();
  for (std::size_t k = 0; k < proofs_.size(); ++k) {
    Proof& proof = proofs_[k];
    if (proof.pairs > 0) {
      ascending_.push_back(static_cast<int>(k));
    } else if (proof.pairs == 0) {
      for (const int id : proof.bodies) {
        if (id >= num_link_bodies_ && k < bodies_[id].numbers.size()) bodies_[id].numbers[k] = -1;
      }
      proof = {0, Linkage(), {}, -1};
    }
  }
  if (ascending_.empty()) {  // one without bodies
    if (proofs_.empty()) proofs_.emplace_back();
    proofs_[0] = {0, arm_->tree.linkage(), {}, -1};
    ascending_ = {0};
  }
  std::sort(ascending_.begin(), ascending_.end(),
            [&](int a, int b) { return proofs_[a].separation < proofs_[b].separation; });
}

int Cell::placeOf(int id) const {
  if (id < num_link_bodies_) return id;
  const auto key = [&](const Body& body) {
    return std::make_tuple(body.node < 0, orders_[body.entity], body.element);
  };
  int place = num_link_bodies_;
  for (const std::vector<int>* const like : {&carried_, &obstacles_}) {
    place += static_cast<int>(std::count_if(like->begin(), like->end(), [&](int other) {
      return other >= num_link_bodies_ && key(bodies_[other]) < key(bodies_[id]);
    }));
  }
  return place;
}

template <typename Result>
Result Cell::withBodies(const Proof& proof, Result result) {
  if (result.body_a < 0) return result;
  result.body_a = proof.bodies[result.body_a];
  result.body_b = proof.bodies[result.body_b];
  return result;
}

template <typename Result>
bool Cell::setNames(Result& result) const {
  if (result.body_a < 0) return false;
  int a = result.body_a, b = result.body_b;
  const bool swaps = placeOf(a) > placeOf(b);
  if (swaps) std::swap(a, b);
  result.body_a = placeOf(a);
  result.body_b = placeOf(b);
  result.a = entities_[bodies_[a].entity].name;
  result.b = entities_[bodies_[b].entity].name;
  return swaps;
}

RobotMotion Cell::checkMotion(const std::vector<Proof>& proofs, const Eigen::VectorXd& q0,
                              const Eigen::VectorXd& q1, const MotionRequest& request) const {
  const auto isEarlier = [](const MotionResult& a, const MotionResult& b) {
    return std::make_pair(a.from, a.to) < std::make_pair(b.from, b.to);
  };
  RobotMotion result;
  MotionCounts counts;
  for (const int k : ascending_) {
    const Proof& proof = proofs[k];
    MotionRequest padded = request;
    padded.min_separation += proof.separation;
    const MotionResult answer = kios::checkMotion(proof.linkage, q0, q1, padded);
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
    if (first || better) static_cast<MotionResult&>(result) = withBodies(proof, answer);
    if (contact && !request.first_contact) break;
  }
  result.counts = counts;
  setNames(result);
  return result;
}

RobotRange Cell::named(RangeResult result) const {
  RobotRange range;
  static_cast<RangeResult&>(range) = std::move(result);
  if (setNames(range)) std::swap(range.point_a, range.point_b);
  return range;
}

RangeResult Cell::leastOf(
    std::size_t parts, const RangeRequest& request,
    const std::function<RangeResult(std::size_t part, const RangeRequest&)>& ask) {
  if (request.max_queries < 0) refuse("max_queries is negative.");
  RangeResult least;
  least.lower = std::numeric_limits<double>::infinity();
  least.complete = true;
  for (std::size_t i = 0; i < parts; ++i) {
    RangeRequest narrowed = request;
    narrowed.max_queries =
        std::max(0LL, request.max_queries - least.queries) / static_cast<long long>(parts - i);
    if (!least.at.empty()) {
      const double enough = least.upper - std::max(request.abs_err, request.rel_err * least.upper);
      narrowed.ceiling = std::min(request.ceiling, enough);
    }
    RangeResult part = ask(i, narrowed);
    const double lower = std::min(part.lower, least.lower);
    const bool complete = part.complete && least.complete;
    const long long queries = part.queries + least.queries;
    if (part.upper < least.upper) least = std::move(part);
    least.lower = lower;
    least.complete = complete;
    least.queries = queries;
  }
  return least;
}

// The widest skins come first: their pairs are likely to be the nearest.
RobotRange Cell::leastClearance(
    const RangeRequest& request,
    const std::function<RangeResult(const Linkage&, const RangeRequest&)>& ask) const {
  return named(leastOf(ascending_.size(), request, [&](std::size_t i, RangeRequest padded) {
    const Proof& proof = proofs_[ascending_[ascending_.size() - 1 - i]];
    padded.padding += proof.separation;
    return withBodies(proof, ask(proof.linkage, padded));
  }));
}

std::vector<RobotRange> Cell::leastClearances(
    const RangeRequest& request,
    const std::function<std::vector<RangeResult>(const Linkage&, const RangeRequest&)>& ask) const {
  std::vector<RobotRange> all;
  for (const int k : ascending_) {
    const Proof& proof = proofs_[k];
    RangeRequest padded = request;
    padded.padding += proof.separation;
    for (RangeResult& result : ask(proof.linkage, padded)) {
      all.push_back(named(withBodies(proof, std::move(result))));
    }
  }
  std::stable_sort(all.begin(), all.end(),
                   [](const RobotRange& x, const RobotRange& y) { return x.lower < y.lower; });
  return all;
}

}  // namespace kios::robot
