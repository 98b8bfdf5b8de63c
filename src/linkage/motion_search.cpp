// SPDX-FileCopyrightText: 2026 The fcl_kios authors
// SPDX-License-Identifier: BSD-3-Clause
#include "linkage/motion_search.h"

#include <algorithm>
#include <cmath>

#include "linkage/orbits.h"
#include "linkage/slab_motion.h"
#include "volume/rounding.h"

namespace kios::articulated {
namespace {

constexpr std::size_t kCached = 16;
// Root volumes that prove so much of an interval spare it a query.
constexpr double kRootsShare = 0.35;
constexpr double kSlabShare = 0.35;
// Looks at a pair before slabs between its triangles are tried.
constexpr int kPatience = 40;
// Where a query proves so much of the path they aren't: at that pace a few more looks decide it.
constexpr double kFastWay = 1.0 / 256;
// Turns are tried after so many looks, and one more for so many triangles; or once queries that
// prove no more than this of the path have made an expansion for each triangle.
constexpr int kLooksBeforeOrbits = 4;
constexpr int kTrianglesOfLook = 128;
constexpr double kLittleWay = 1.0 / 32;
constexpr long long kTestsOfQuery = 100;  // take as long as one
// Where so many intervals can't be decided, no contact is looked for in what else is left.
constexpr int kMostUndecided = 256;

}  // namespace

double middleOf(double from, double to) {
  constexpr double kAside = 0.1;
  const double length = to - from, middle = from + 0.5 * length;
  const double low = middle - kAside * length, high = middle + kAside * length;
  if (!(high > low)) return middle;
  for (double step = std::ldexp(1.0, std::ilogb(length)); step > 0.125 * kAside * length;
       step *= 0.5) {
    const double s = std::ceil(low / step) * step;
    if (s <= high) return s;
  }
  return middle;
}

SpareScratch::~SpareScratch() { delete spare_.load(std::memory_order_acquire); }

std::unique_ptr<Scratch> SpareScratch::take() const {
  std::unique_ptr<Scratch> scratch(spare_.exchange(nullptr, std::memory_order_acquire));
  return scratch ? std::move(scratch) : std::make_unique<Scratch>();
}

void SpareScratch::giveBack(std::unique_ptr<Scratch> scratch) const {
  delete spare_.exchange(scratch.release(), std::memory_order_acq_rel);
}

MotionSearch::MotionSearch(const Path& path, const MotionRequest& request)
    : path_(path),
      request_(request),
      queries_(path, request.min_separation, counts_),
      scratch_(path.linkage().spare.take()),
      cache_(scratch_->configurations),
      suspects_(scratch_->suspects),
      waiting_(scratch_->waiting) {
  counts_.pairs = path.linkage().num_pairs;
  cache_.reserve(kCached);
  suspects_.clear();
  waiting_.clear();
}

MotionSearch::~MotionSearch() { path_.linkage().spare.giveBack(std::move(scratch_)); }

const Configuration& MotionSearch::at(double s) {
  for (std::size_t i = 0; i < cached_; ++i) {
    if (cache_[i].s() == s) return cache_[i];
  }
  ++counts_.configurations;
  std::size_t place = next_;
  if (cached_ < kCached) {
    place = cached_++;
  } else {
    next_ = (next_ + 1) % kCached;
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

// Across the direction of the nearest points most of the motion doesn't matter.
MotionSearch::Look MotionSearch::widened(const Task& task, const Look& look, double slab,
                                         Pair& pair, const Configuration& c) const {
  using Outcome = Look::Outcome;
  if (look.outcome != Outcome::kPart && look.outcome != Outcome::kUndecided) return look;
  const double s = look.s;
  double gap = slab - request_.min_separation;
  const bool planes = !(gap > 0);
  if (planes) gap = queries_.slab(pair, c, kInfinity) - request_.min_separation;
  if (!(gap > 0)) return look;
  const SlabMotion motion(c, pair, planes);
  Look wide = look;
  wide.outcome = Outcome::kPart;
  const double back = std::max(0.0, s - task.from) * (1 + 0x1p-50),
               forth = std::max(0.0, task.to - s) * (1 + 0x1p-50);
  const double way_back = motion.timeFor(gap, -1, back), way_forth = motion.timeFor(gap, 1, forth);
  const double from = s - way_back * (1 - 0x1p-40) + 0x1p-52,
               to = s + way_forth * (1 - 0x1p-40) - 0x1p-52;
  wide.from = way_back >= back ? task.from : std::min(look.from, from);
  wide.to = way_forth >= forth ? task.to : std::max(look.to, to);
  if (wide.from <= task.from && wide.to >= task.to) wide.outcome = Outcome::kProven;
  wide.way = std::max(look.way, std::min(way_back, way_forth));
  return wide;
}

MotionSearch::Look MotionSearch::look(const Task& task) {
  using Outcome = Look::Outcome;
  ++counts_.queries;
  const Look known = knownLocally(task);
  if (known.outcome != Outcome::kUndecided) return known;
  Pair& pair = suspects_[task.suspect].pair;
  const double s = task.look_at;
  const Configuration& c = at(s);
  const PairMotion motion(c.motion(pair.a, pair.shared), c.motion(pair.b, pair.shared));
  const double half = std::max(s - task.from, task.to - s) * (1 + 0x1p-50);
  const double moved = motion.during(half), enough = request_.min_separation + moved;
  const double roots = task.roots > -kInfinity ? task.roots : queries_.rootBound(pair, c, enough);
  const double roots_left = roots - request_.min_separation;
  if (roots_left > moved || (roots_left > 0 && roots_left > kRootsShare * moved)) {
    return proven(task, s, roots, motion);
  }
  const Look nothing = {Outcome::kUndecided, s, s, s, 0};
  const Look before = widened(task, nothing, -kInfinity, pair, c);
  if (before.outcome == Outcome::kProven) return before;
  if (before.outcome == Outcome::kPart &&
      before.to - before.from > kSlabShare * (task.to - task.from)) {
    return before;
  }
  const bool splits = task.to - task.from > request_.resolution;
  if (s == 1 && task.from == 0 && splits) {  // a query tells more in the middle
    if (before.outcome == Outcome::kPart) return before;
    return {Outcome::kPart, s, s, s, 0};
  }
  const Look by_triangles = local(task);
  if (by_triangles.to - by_triangles.from > kSlabShare * (task.to - task.from)) {
    return by_triangles;
  }
  const long long expansions = counts_.expansions;
  const Nearness near = queries_.ask(pair, c, enough, roots);
  suspects_[task.suspect].expansions += counts_.expansions - expansions;
  if (near.contact) return {Outcome::kContact, s, s, s, 0};
  const Look by_query =
      widened(task, proven(task, s, std::max(near.apart, roots), motion), near.slab, pair, c);
  double& way = suspects_[task.suspect].way;
  way = std::max(0.5 * way, by_query.to - by_query.from);
  return by_query;
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

void MotionSearch::tryOrbits(int suspect, const Configuration& c) {
  constexpr int kLooks = 3;
  Suspect& own = suspects_[suspect];
  const bool hopeful = nearestOrbitsApart(path_, own.pair, c, request_.min_separation);
  own.orbits = hopeful ? own.orbits + 1 : 0;
  if (own.orbits < kLooks) return;
  own.orbits = Suspect::kNoOrbits;
  long long cost = 0;
  const bool proven = orbitsApart(path_, own.pair, c, request_.min_separation, cost);
  counts_.queries += cost / kTestsOfQuery;
  if (!proven) return;
  own.place = static_cast<int>(local_.size());
  local_.emplace_back();
  local_.back().to = 1;
}

// Goes on beyond the interval, as far as it gets. One that proved less than queries at the same
// cost is followed by pauses, each several times as long.
MotionSearch::Look MotionSearch::local(const Task& task) {
  constexpr int kLongestPause = 1000;
  const Look nothing = knownLocally(task);
  Suspect& suspect = suspects_[task.suspect];
  const Modeld *a = path_.linkage().bodies[suspect.pair.a].model,
               *b = path_.linkage().bodies[suspect.pair.b].model;
  ++suspect.looks;
  if (!a && !b) return nothing;
  const int triangles = (a ? a->num_tris : 0) + (b ? b->num_tris : 0);
  const bool slow =
      suspect.way <= kFastWay && suspect.looks >= kLooksBeforeOrbits + triangles / kTrianglesOfLook;
  const bool costly = suspect.way <= kLittleWay && suspect.expansions >= triangles;
  // About two pivots: four nodes a triangle, two tests each.
  const long long attempt = 8LL * triangles / kTestsOfQuery;
  if ((slow || costly) && suspect.orbits != Suspect::kNoOrbits &&
      counts_.queries + attempt < request_.max_queries) {
    tryOrbits(task.suspect, at(task.look_at));
    const Look look = knownLocally(task);
    if (look.outcome == Look::Outcome::kProven) return look;
  }
  if (suspect.looks <= kPatience || suspect.way > kFastWay) return nothing;
  if (suspect.place < 0) {
    suspect.place = static_cast<int>(local_.size());
    local_.emplace_back();
    local_.back().slabs =
        std::make_unique<LocalSlabs>(path_, suspect.pair, request_.min_separation);
  }
  Local& own = local_[suspect.place];
  if (own.rest > 0) {
    --own.rest;
    return nothing;
  }
  // No more is spent than was on queries, lest a pair that these prove anyhow takes much longer.
  const long long left = std::max(0LL, request_.max_queries - counts_.queries);
  const long long most = kTestsOfQuery * std::min<long long>(left, suspect.looks);
  const long long before = own.slabs->cost();
  own.from = task.from;
  own.to = own.slabs->provenFrom(task.from, 1, most);
  const long long queries = (own.slabs->cost() - before) / kTestsOfQuery;
  counts_.queries += queries;
  constexpr double kFavour = 3;  // of queries, which find contacts as well
  const bool paid = own.to - own.from > kFavour * suspect.way * static_cast<double>(queries);
  own.pause = paid ? 0 : std::min(4 * own.pause + 3, kLongestPause);
  own.rest = own.pause;
  return knownLocally(task);
}

bool MotionSearch::contactAt(double s, int suspect) {
  ++counts_.queries;
  return queries_.ask(suspects_[suspect].pair, at(s), request_.min_separation, -kInfinity).contact;
}

// True if an end of the interval is in contact: paths begin and end in poses that touch. Else the
// first interval of this kind is kept as the answer, should no contact turn up.
bool MotionSearch::undecided(const Task& task, const Look& look) {
  const double half = 0.25 * request_.resolution;
  const double from = std::max(task.from, look.s - half), to = std::min(task.to, look.s + half);
  for (const double s : {from, to}) {
    if (!contactAt(s, task.suspect)) continue;
    end_ = {MotionVerdict::kContact, s, s, task.suspect};
    return true;
  }
  suspects_[task.suspect].undecided = true;
  if (end_.suspect < 0) end_ = {MotionVerdict::kUnresolved, from, to, task.suspect};
  return false;
}

void MotionSearch::anyContact() {
  using Outcome = Look::Outcome;
  std::make_heap(waiting_.begin(), waiting_.end(), LeastProven());
  const auto push = [&](int suspect, double from, double to, const Look& look) {
    if (!(from < to)) return;
    // What is short for the way that was proven nearby is likely to be proven from an end of the
    // path, where other pairs are looked at too.
    constexpr double kLikely = 0.7;
    const bool near = to - from < kLikely * look.way;
    const double at = near && to == 1 ? 1 : near && from == 0 ? 0 : middleOf(from, to);
    // A pair that can't be decided hardly tells more elsewhere: the others come first. So they do
    // before one that takes many looks, which is then followed through time, as slabs between
    // triangles are.
    const Suspect& own = suspects_[suspect];
    const bool many = own.undecided || own.looks > kPatience;
    const double margin = many ? (own.undecided ? 4 : 2) + from : look.way - 0.5 * (to - from);
    waiting_.push_back({suspect, from, to, at, margin});
    std::push_heap(waiting_.begin(), waiting_.end(), LeastProven());
  };
  for (int undecided_count = 0; !waiting_.empty() && undecided_count < kMostUndecided;) {
    std::pop_heap(waiting_.begin(), waiting_.end(), LeastProven());
    const Task task = waiting_.back();
    waiting_.pop_back();
    if (budgetSpent()) {
      if (end_.suspect < 0) end_ = {MotionVerdict::kBudgetSpent, task.from, task.to, task.suspect};
      return;
    }
    const Look result = look(task);
    switch (result.outcome) {
      case Outcome::kProven:
        break;
      case Outcome::kContact:
        end_ = {MotionVerdict::kContact, result.s, result.s, task.suspect};
        return;
      case Outcome::kPart:
        if (task.to - task.from > request_.resolution) {
          push(task.suspect, task.from, result.from, result);
          push(task.suspect, result.to, task.to, result);
          break;
        }
        ++undecided_count;
        if (undecided(task, result)) return;
        break;
      case Outcome::kUndecided:
        ++undecided_count;
        if (undecided(task, result)) return;
        push(task.suspect, task.from, result.s - request_.resolution, result);
        push(task.suspect, result.s + request_.resolution, task.to, result);
    }
  }
}

MotionAnswer MotionSearch::run() {
  if (request_.first_contact) {
    findSuspects();
    if (!containedAt(0)) firstContact();
  } else if (request_.min_separation > 0 || !touchingAtEnd()) {
    const bool found = (!suspected_ && findSuspects()) || (!looked_at_end_ && containedAt(0.5));
    if (!found) anyContact();
  }
  MotionAnswer answer;
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
