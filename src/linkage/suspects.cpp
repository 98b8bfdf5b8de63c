// SPDX-FileCopyrightText: 2026 The fcl_kios authors
// SPDX-License-Identifier: BSD-3-Clause
//
// What a search finds of all pairs at once, before it looks at the intervals of those that are
// left: the suspects, and contacts at single configurations.

#include <algorithm>

#include "linkage/motion_search.h"
#include "linkage/tuning.h"
#include "solid/solid_mark.h"

namespace kios::articulated {

std::vector<Pair>& MotionSearch::gather(double s, double time) {
  std::vector<Pair>& pairs = scratch_.pairs;
  pairs.clear();
  const auto add = [&](const Pair& pair) {
    queries_.requireServed(pair.a, pair.b);
    pairs.push_back(pair);
  };
  if (only_) {
    add(*only_);
  } else {
    scratch_.near_pairs.forEach(path_, at(s), request_.min_separation, time, add);
  }
  return pairs;
}

// A pair is asked by its surfaces, and where these are apart what lies in what.
bool MotionSearch::stillTouching(Pair pair, double s) {
  const Configuration& c = at(s);
  const double separation = request_.min_separation;
  if (queries_.rootBound(pair, c, separation) > separation) return false;
  ++counts_.queries;
  if (queries_.slab(pair, c, separation) > separation) return false;
  const Nearness near = queries_.ask(pair, c, separation);
  const bool contact = near.contact || (queries_.areSolids(pair) && queries_.inContact(pair, c));
  if (!contact && near.apart > separation) return false;
  const int suspect = static_cast<int>(suspects_.size());
  suspects_.push_back({pair});
  if (contact) {
    end_ = {MotionVerdict::kContact, s, s, suspect};
  } else if (undecided_.suspect < 0) {  // nor would it be elsewhere
    undecided_ = {MotionVerdict::kUnresolved, 0, request_.resolution, suspect};
  }
  return contact;
}

// Paths that aren't free are in contact at the end more often than not: it comes first. Else most
// pairs are proven for the whole path at its middle, by volumes or a slab. Where volumes leave
// many, they are looked for anew in both halves, rather than one by one. What nothing moves is
// decided here for the whole path.
bool MotionSearch::findSuspects() {
  const bool moves = path_.moves(), first = request_.first_contact;
  if (moves && touchingAtEnd()) return true;
  std::vector<std::pair<double, double>>& intervals = scratch_.intervals;
  intervals.assign(1, {0, 1});
  for (std::size_t i = 0; i < intervals.size(); ++i) {
    const auto [from, to] = intervals[i];
    const double s = moves ? 0.5 * (from + to) : 1, half = moves ? 0.5 * (to - from) : 0;
    const std::vector<Pair>& pairs = gather(s, half);
    for (const Pair& pair : pairs) {
      if (i > 0 || !path_.still(pair.a, pair.b, pair.shared)) continue;
      if (stillTouching(pair, first ? 0 : s)) return true;
    }
    const std::size_t before = suspects_.size();
    addSuspects(pairs, s, half);
    if (touching(s, before)) return true;
    const std::size_t found = suspects_.size() - before;
    if (i == 0) counts_.proven_at_once = counts_.pairs - static_cast<long long>(found);
    if (found > tuning::kMany && half > tuning::kShortest && !first) {
      suspects_.resize(before);
      intervals.emplace_back(from, s);
      intervals.emplace_back(s, to);
    } else {
      dismissBySlabs(before, from, to);
    }
  }
  return false;
}

void MotionSearch::addSuspects(const std::vector<Pair>& pairs, double s, double time) {
  const Configuration& c = at(s);
  for (const Pair& pair : pairs) {
    if (path_.still(pair.a, pair.b, pair.shared)) continue;
    double enough = request_.min_separation;
    if (time > 0) {
      const PairMotion motion(c.motion(pair.a, pair.shared), c.motion(pair.b, pair.shared));
      enough += motion.during(time);
    }
    const double roots = queries_.rootBound(pair, c, enough);
    if (!(roots > enough)) suspects_.push_back({pair, roots, enough});
  }
}

void MotionSearch::dismissBySlabs(std::size_t first, double from, double to) {
  const double s = 0.5 * (from + to);
  std::size_t kept = first;
  for (std::size_t i = first; i < suspects_.size(); ++i) {
    Suspect& suspect = suspects_[kept] = suspects_[i];
    const Task task = {static_cast<int>(kept), from, to, s, suspect.roots - suspect.enough};
    ++counts_.queries;
    suspect.seen = s;
    const double width = queries_.slab(suspect.pair, at(s), suspect.enough);
    if (width > suspect.enough) continue;
    const Look look = bySlab(task, suspect.pair, at(s), width, true);
    if (look.outcome == Look::Outcome::kProven) continue;
    ++kept;
    if (isMuch(look, task)) {
      pushRest(task, look.from, look.to, look);
    } else {
      enqueue(task);
    }
  }
  suspects_.resize(kept);
}

bool MotionSearch::touchingAtEnd() {
  if (!looks_for_touch_) return false;
  addSuspects(gather(1, 0), 1, 0);
  if (touching(1, 0)) return true;
  suspects_.clear();
  return false;
}

// First the pairs whose volumes overlap most for their size: they are in contact more often than
// not. No query is asked where volumes or a slab part the bodies.
bool MotionSearch::touching(double s, std::size_t first) {
  if (!looks_for_touch_) return false;
  std::vector<std::pair<double, int>>& near = scratch_.near;
  near.clear();
  for (std::size_t i = first; i < suspects_.size(); ++i) {
    const Suspect& suspect = suspects_[i];
    if (suspect.roots > 0) continue;
    near.emplace_back(suspect.roots / queries_.smallerRadius(suspect.pair), static_cast<int>(i));
  }
  std::sort(near.begin(), near.end());
  for (const auto& [depth, i] : near) {
    ++counts_.queries;
    Pair& pair = suspects_[i].pair;
    if (depth > tuning::kDeep && queries_.slab(pair, at(s), 0) > 0) continue;
    if (!queries_.touching(pair, at(s))) continue;
    end_ = {MotionVerdict::kContact, s, s, i};
    return true;
  }
  return false;
}

bool MotionSearch::containedAt(double s) {
  for (std::size_t i = 0; i < suspects_.size(); ++i) {
    Pair& pair = suspects_[i].pair;
    if (!queries_.areSolids(pair)) continue;
    ++counts_.queries;
    const Configuration& c = at(s);
    if (queries_.slab(pair, c, 0) > 0 || !queries_.inContact(pair, c)) continue;
    end_ = {MotionVerdict::kContact, s, s, static_cast<int>(i)};
    return true;
  }
  return false;
}

}  // namespace kios::articulated
