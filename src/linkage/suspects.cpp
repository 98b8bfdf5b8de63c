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
  if (!only_) {
    scratch_.near_pairs.forEach(path_, at(s), request_.min_separation, time, add);
  } else if (time == 0 || !path_.still(only_->a, only_->b, only_->shared)) {
    add(*only_);
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

// Most pairs are so far apart at the middle of the path that half of it doesn't bring them
// together. Where many aren't, they are looked for anew in both halves, rather than one by one.
// Some may touch there.
bool MotionSearch::findSuspects() {
  if (!path_.moves()) return false;
  std::vector<std::pair<double, double>> intervals = {{0, 1}};
  for (std::size_t i = 0; i < intervals.size(); ++i) {
    const double from = intervals[i].first, to = intervals[i].second;
    const double s = 0.5 * (from + to), half = 0.5 * (to - from);
    const std::size_t before = suspects_.size();
    const Configuration& c = at(s);
    scratch_.near.clear();
    for (const Pair& pair : gather(s, half)) {
      const PairMotion motion(c.motion(pair.a, pair.shared), c.motion(pair.b, pair.shared));
      const double moved = motion.during(half) + request_.min_separation;
      const double roots = queries_.rootBound(pair, c, moved);
      if (roots > moved) continue;
      if (!(roots > 0)) scratch_.near.emplace_back(roots, pair);
      suspects_.push_back({pair});
      waiting_.push_back({static_cast<int>(suspects_.size()) - 1, from, to, s, roots - moved});
    }
    const std::size_t found = suspects_.size() - before;
    if (i == 0) counts_.proven_at_once = counts_.pairs - static_cast<long long>(found);
    if (looks_for_touch_ && touching(s)) return true;
    if (found <= tuning::kMany || half <= tuning::kShortest || request_.first_contact) continue;
    suspects_.resize(before);
    waiting_.resize(before);
    intervals.emplace_back(from, s);
    intervals.emplace_back(s, to);
  }
  return false;
}

// What doesn't move is decided here for the whole path: gather() leaves it out elsewhere.
bool MotionSearch::touchingAtEnd() {
  const double s = request_.first_contact ? 0 : 1;
  scratch_.near.clear();
  std::vector<Pair>& pairs = gather(s, 0);
  const auto still = std::partition(pairs.begin(), pairs.end(), [&](const Pair& pair) {
    return !path_.still(pair.a, pair.b, pair.shared);
  });
  for (auto pair = pairs.begin(); looks_for_touch_ && pair != still; ++pair) {
    const double roots = queries_.rootBound(*pair, at(s), 0);
    if (!(roots > 0)) scratch_.near.emplace_back(roots, *pair);
  }
  return touching(s) ||
         std::any_of(still, pairs.end(), [&](const Pair& pair) { return stillTouching(pair, s); });
}

// First the pairs whose volumes overlap most for their size: they are in contact more often than
// not. No query is asked where volumes or a slab part the bodies.
bool MotionSearch::touching(double s) {
  const Configuration& c = at(s);
  std::vector<std::pair<double, Pair>>& near = scratch_.near;
  for (auto& [roots, pair] : near) roots /= queries_.smallerRadius(pair);
  std::sort(near.begin(), near.end(),
            [](const auto& a, const auto& b) { return a.first < b.first; });
  for (auto& [roots, pair] : near) {
    ++counts_.queries;
    if (roots > tuning::kDeep && queries_.slab(pair, c, 0) > 0) continue;
    if (!queries_.touching(pair, c)) continue;
    suspects_.assign(1, {pair});
    end_ = {MotionVerdict::kContact, s, s, 0};
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
