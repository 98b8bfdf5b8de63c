// SPDX-FileCopyrightText: 2026 The fcl_kios authors
// SPDX-License-Identifier: BSD-3-Clause
#include "linkage/motion_search.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include "linkage/orbits.h"
#include "linkage/slab_motion.h"
#include "linkage/tuning.h"
#include "volume/errors.h"
#include "volume/rounding.h"

namespace kios::articulated {
double middleOf(double from, double to) {
  const double length = to - from, middle = from + 0.5 * length;
  const double low = middle - tuning::kAside * length, high = middle + tuning::kAside * length;
  if (!(high > low)) return middle;
  for (double step = std::ldexp(1.0, std::ilogb(length)); step > 0.125 * tuning::kAside * length;
       step *= 0.5) {
    const double s = std::ceil(low / step) * step;
    if (s <= high) return s;
  }
  return middle;
}

SpareScratch::~SpareScratch() { exchange(nullptr); }

std::unique_ptr<Scratch> SpareScratch::exchange(std::unique_ptr<Scratch> by) const {
  return std::unique_ptr<Scratch>(kept_.exchange(by.release(), std::memory_order_acq_rel));
}

MotionSearch::MotionSearch(const Path& path, const MotionRequest& request, const Pair* only)
    : path_(path),
      request_(request),
      only_(only),
      queries_(path, request.min_separation, counts_),
      looks_for_touch_(!request.first_contact && request.min_separation == 0),
      own_(path.linkage().spare.exchange(nullptr)),
      scratch_(own_ ? *own_ : *(own_ = std::make_unique<Scratch>())),
      cache_(scratch_.configurations),
      suspects_(scratch_.suspects),
      waiting_(scratch_.waiting) {
  counts_.pairs = only ? 1 : path.linkage().renewed.pairsOf(path.linkage());
  cache_.reserve(tuning::kCached);
  suspects_.clear();
  waiting_.clear();
}

MotionSearch::~MotionSearch() { path_.linkage().spare.exchange(std::move(own_)); }

const Configuration& MotionSearch::at(double s) {
  for (std::size_t i = 0; i < cached_; ++i) {
    if (cache_[i].s() == s) return cache_[i];
  }
  ++counts_.configurations;
  std::size_t place = next_;
  if (cached_ < tuning::kCached) {
    place = cached_++;
  } else {
    next_ = (next_ + 1) % tuning::kCached;
  }
  if (place == cache_.size()) {
    cache_.emplace_back(path_, s);
  } else {
    cache_[place].set(path_, s);
  }
  return cache_[place];
}

MotionSearch::Look MotionSearch::proven(const Task& task, double s, double apart,
                                        const PairMotion& motion) const {
  using Outcome = Look::Outcome;
  const double left = apart - request_.min_separation;
  const double half = std::max(s - task.from, task.to - s) * (1 + 0x1p-50);
  if (left > motion.during(half)) return {Outcome::kProven, s, task.from, task.to};
  if (!(left > 0)) return {Outcome::kUndecided, s, s, s, 0};
  const double way = motion.timeFor(left, half) * (1 - 0x1p-40);
  const double from = s - way + 0x1p-52, to = s + way - 0x1p-52;  // rounded towards s
  if (!(from < to)) return {Outcome::kPart, s, s, s, 0};
  return {Outcome::kPart, s, from, to, way};
}

// Across the slab most of the motion doesn't matter.
MotionSearch::Look MotionSearch::bySlab(const Task& task, const Pair& pair, const Configuration& c,
                                        double width, bool planes) const {
  using Outcome = Look::Outcome;
  const double s = task.look_at;
  const double gap = width - request_.min_separation;
  if (!(gap > 0)) return {Outcome::kUndecided, s, s, s, 0};
  const SlabMotion motion(c, pair, planes);
  const double back = std::max(0.0, s - task.from) * (1 + 0x1p-50),
               forth = std::max(0.0, task.to - s) * (1 + 0x1p-50);
  const double way_back = motion.timeFor(gap, -1, back), way_forth = motion.timeFor(gap, 1, forth);
  Look look = {Outcome::kPart, s, task.from, task.to, std::min(way_back, way_forth)};
  if (way_back < back) look.from = std::min(s, s - way_back * (1 - 0x1p-40) + 0x1p-52);
  if (way_forth < forth) look.to = std::max(s, s + way_forth * (1 - 0x1p-40) - 0x1p-52);
  if (look.from <= task.from && look.to >= task.to) look.outcome = Outcome::kProven;
  return look;
}

bool MotionSearch::isMuch(const Look& look, const Task& task) {
  return look.to - look.from > tuning::kSlabShare * (task.to - task.from);
}

MotionSearch::Look MotionSearch::look(const Task& task) {
  using Outcome = Look::Outcome;
  ++counts_.queries;
  const Look known = knownLocally(task);
  if (known.outcome != Outcome::kUndecided) return known;
  Suspect& suspect = suspects_[task.suspect];
  Pair& pair = suspect.pair;
  const double s = task.look_at;
  const Configuration& c = at(s);
  const PairMotion motion(c.motion(pair.a, pair.shared), c.motion(pair.b, pair.shared));
  const double half = std::max(s - task.from, task.to - s) * (1 + 0x1p-50);
  const double moved = motion.during(half), enough = request_.min_separation + moved;
  if (std::exchange(suspect.seen, -1) != s) {
    suspect.roots = queries_.rootBound(pair, c, enough);
    if (suspect.roots > enough) return proven(task, s, suspect.roots, motion);
    const double width = queries_.slab(pair, c, enough);
    if (width > enough) return {Outcome::kProven, s, task.from, task.to};
    const Look by_volumes = bySlab(task, pair, c, width, true);
    if (isMuch(by_volumes, task)) return by_volumes;
  }
  const Look by_triangles = local(task);
  if (isMuch(by_triangles, task)) return by_triangles;
  const long long before = queries_.cost();
  const Configuration& again = at(s);  // as a search for turns may have taken its place
  const Nearness near = queries_.ask(pair, again, enough);
  suspect.asked += queries_.cost() - before;
  if (near.contact) return {Outcome::kContact, s, s, s, 0};
  // The query knows a better direction.
  const double width = near.slab ? near.apart : queries_.slab(pair, again, kInfinity);
  const Look by_slab = bySlab(task, pair, again, width, !near.slab);
  const Look by_query = proven(task, s, std::max(near.apart, suspect.roots), motion);
  suspect.way = std::max(0.5 * suspect.way, by_query.to - by_query.from);
  return by_slab.to - by_slab.from > by_query.to - by_query.from ? by_slab : by_query;
}

MotionSearch::Look MotionSearch::knownLocally(const Task& task) const {
  using Outcome = Look::Outcome;
  const Look nothing = {Outcome::kUndecided, task.from, task.from, task.from, 0};
  const int place = suspects_[task.suspect].place;
  if (place < 0) return nothing;
  const Local& own = local_[place];
  if (!(own.from <= task.from && own.to > task.from)) return nothing;
  if (own.to >= task.to) return {Outcome::kProven, task.from, task.from, task.to, 0};
  return {Outcome::kPart, task.from, task.from, own.to, own.to - task.from};
}

// Goes on beyond the interval, as far as it gets.
MotionSearch::Look MotionSearch::local(const Task& task) {
  const Look nothing = knownLocally(task);
  Suspect& suspect = suspects_[task.suspect];
  const Modeld *a = path_.linkage().bodies[suspect.pair.a].model,
               *b = path_.linkage().bodies[suspect.pair.b].model;
  suspect.asked += tuning::kTestsOfQuery;
  if (!a && !b) return nothing;
  const auto own = [&]() -> Local& {
    if (suspect.place < 0) {
      suspect.place = static_cast<int>(local_.size());
      local_.emplace_back();
    }
    return local_[suspect.place];
  };
  const long long left = std::max(0LL, request_.max_queries - counts_.queries);
  // What finds little takes about a test a triangle.
  const long long attempt =
      continuous::tuning::kTestsOfMoving * ((a ? a->num_tris : 0) + (b ? b->num_tris : 0));
  const bool last = isShortest(task) && !suspect.undecided && contact_.suspect != task.suspect;
  if (!last && suspect.asked < std::max(suspect.retry, attempt)) return nothing;
  if (suspect.turns && attempt / tuning::kTestsOfQuery < left) {
    suspect.turns = false;
    long long cost = 0;
    Pair pair = suspect.pair;
    const double apart = queries_.measure(pair, at(0.5), kInfinity, 1).upper;
    const bool proven = orbitsApart(path_, pair, at(0.5), apart, request_.min_separation, cost);
    counts_.queries += cost / tuning::kTestsOfQuery;
    if (proven) {
      own().to = 1;
      return knownLocally(task);
    }
  }
  Local& slabs = own();
  if (!slabs.slabs) {
    slabs.slabs = std::make_unique<LocalSlabs>(path_, suspect.pair, request_.min_separation);
  }
  // No more is spent than was on queries since the last failure, lest a pair that these decide
  // anyhow takes much longer. Where they can't decide it, ever more is.
  const long long before = slabs.slabs->cost(), all = tuning::kTestsOfQuery * left;
  long long most = std::min(all, std::max(tuning::kTestsOfQuery, suspect.asked / 2));
  long long cost = 0;
  slabs.from = task.from;
  do {
    slabs.to = slabs.slabs->provenFrom(task.from, 1, most);
    cost = slabs.slabs->cost() - before;
    most *= 2;
  } while (last && slabs.to == slabs.from && cost + most <= all);
  counts_.queries += cost / tuning::kTestsOfQuery;
  const double spared = (slabs.to - slabs.from) / std::max(suspect.way, request_.resolution);
  const bool saves =
      spared * static_cast<double>(tuning::kTestsOfQuery) > static_cast<double>(cost);
  if (!saves) suspect.retry = 2 * suspect.asked;
  return knownLocally(task);
}

bool MotionSearch::contactAt(double s, int suspect) {
  ++counts_.queries;
  return queries_.ask(suspects_[suspect].pair, at(s), request_.min_separation).contact;
}

MotionResult MotionSearch::run() {
  // Where single configurations are looked at, what lies in what is told as well.
  const bool found = findSuspects();
  const bool contained = !looks_for_touch_ && containedAt(request_.first_contact ? 0 : 0.5);
  if (!found && !contained) search();
  MotionResult answer;
  answer.verdict = end_.verdict;
  answer.from = end_.from;
  answer.to = end_.to;
  if (end_.suspect >= 0) {
    answer.body_a = suspects_[end_.suspect].pair.a;
    answer.body_b = suspects_[end_.suspect].pair.b;
  }
  answer.counts = counts_;
  return answer;
}

}  // namespace kios::articulated

namespace kios {

MotionResult checkMotion(const Linkage& linkage, const Eigen::VectorXd& q0,
                         const Eigen::VectorXd& q1, const MotionRequest& request) {
  require(request.min_separation >= 0 && request.min_separation <= 0x1p300,
          "MotionRequest::min_separation", request.min_separation, "finite and >= 0");
  require(request.resolution >= 0x1p-40 && request.resolution <= 1, "MotionRequest::resolution",
          request.resolution, "in [2^-40, 1]");
  require(request.max_queries >= 0, "MotionRequest::max_queries",
          static_cast<double>(request.max_queries), ">= 0");
  const auto impl = linkage.impl().current();
  const articulated::Path path(*impl, q0, q1);
  return articulated::MotionSearch(path, request).run();
}

}  // namespace kios
