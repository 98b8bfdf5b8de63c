// SPDX-FileCopyrightText: 2026 The fcl_kios authors
// SPDX-License-Identifier: BSD-3-Clause
//
// What a search finds of all pairs at once, before it looks at the intervals of those that are
// left: the suspects, and contacts at single configurations.

#include <algorithm>
#include <iterator>
#include <limits>

#include "linkage/motion_search.h"
#include "solid/solid_mark.h"

namespace kios::articulated {
namespace {

constexpr std::size_t kAll = std::numeric_limits<std::size_t>::max();

}  // namespace

std::vector<Pair>& MotionSearch::gather(double s, double time, std::size_t most) {
  std::vector<Pair>& pairs = scratch_->pairs;
  pairs.clear();
  scratch_->near_pairs.forEach(path_, at(s), request_.min_separation, time, most,
                               [&](const Pair& pair) { pairs.push_back(pair); });
  return pairs;
}

bool MotionSearch::movesWithin(double radii) const {
  const Linkage::Impl& linkage = path_.linkage();
  return std::all_of(linkage.carried.begin(), linkage.carried.end(),
                     [&](const CarriedBody& carried) {
                       return !(path_.swept(carried.body, 0) >
                                radii * linkage.bodies[carried.body].content.radius);
                     });
}

// Most pairs are so far apart at the middle of the path that half of it doesn't bring them
// together. Where many aren't, they are looked for anew in both halves, rather than one by one.
// The middles are looked at for contacts too: on a long way, where one is likely, before the pairs
// of all of it are gathered, which takes several times as long; else once these are many.
bool MotionSearch::findSuspects() {
  constexpr std::size_t kMany = 16;
  constexpr double kShortest = 0.125, kFar = 32;
  std::vector<Interval>& intervals = scratch_->intervals;
  intervals.assign(1, {0, 1});
  const bool contacts = looked_at_end_ && !request_.first_contact;
  for (std::size_t i = 0; i < intervals.size(); ++i) {
    const auto [from, to] = intervals[i];
    const double s = 0.5 * (from + to);
    const bool far = !movesWithin(kFar / (to - from));
    if (contacts && far && touching(overlapping(gather(s, 0, kAll), s), s)) return true;
    const std::vector<Pair>& pairs = gather(s, 0.5 * (to - from), kAll);
    const std::size_t before = suspects_.size();
    suspect(pairs, from, s, to);
    const std::size_t found = suspects_.size() - before;
    if (i == 0) notProvenAtOnce(found);
    if (found <= kMany || to - from <= kShortest || request_.first_contact) continue;
    if (contacts && !far && touching(overlapping(before), s)) return true;
    suspects_.erase(suspects_.begin() + static_cast<std::ptrdiff_t>(before), suspects_.end());
    waiting_.erase(waiting_.begin() + static_cast<std::ptrdiff_t>(before), waiting_.end());
    intervals.push_back({from, s});
    intervals.push_back({s, to});
  }
  return false;
}

// A short path is seen through from there if few pairs are left, for which all is known then that
// contacts are looked for by.
bool MotionSearch::touchingAtEnd() {
  constexpr std::size_t kFew = 12;
  constexpr double kNear = 8;
  looked_at_end_ = true;
  if (movesWithin(kNear)) {
    const std::vector<Pair>& pairs = gather(1, 1, kFew);
    if (pairs.size() <= kFew) {
      suspect(pairs, 0, 1, 1);
      notProvenAtOnce(suspects_.size());
      return touching(overlapping(0), 1);
    }
  }
  return touching(overlapping(gather(1, 0, kAll), 1), 1);
}

void MotionSearch::suspect(const std::vector<Pair>& pairs, double from, double s, double to) {
  suspected_ = true;
  const Configuration& c = at(s);
  const double time = std::max(s - from, to - s);
  for (const Pair& pair : pairs) {
    queries_.requireServed(pair.a, pair.b);
    const PairMotion motion(c.motion(pair.a, pair.shared), c.motion(pair.b, pair.shared));
    const double moved = motion.during(time) + request_.min_separation;
    const double roots = queries_.rootBound(pair, c, moved);
    if (roots > moved) continue;
    suspects_.push_back({pair, roots});
    waiting_.push_back(
        {static_cast<int>(suspects_.size()) - 1, from, to, s, roots - moved, false, roots});
  }
}

std::vector<Suspect>& MotionSearch::overlapping(std::size_t first) {
  std::vector<Suspect>& near = scratch_->near;
  near.clear();
  std::copy_if(suspects_.begin() + static_cast<std::ptrdiff_t>(first), suspects_.end(),
               std::back_inserter(near), [](const Suspect& pair) { return pair.roots <= 0; });
  return near;
}

std::vector<Suspect>& MotionSearch::overlapping(const std::vector<Pair>& pairs, double s) {
  const Configuration& c = at(s);
  std::vector<Suspect>& near = scratch_->near;
  near.clear();
  for (const Pair& pair : pairs) {
    queries_.requireServed(pair.a, pair.b);
    const double roots = queries_.rootBound(pair, c, 0);
    if (roots <= 0) near.push_back({pair, roots});
  }
  return near;
}

// First the pairs whose volumes overlap most for their size: they are in contact more often than
// not, and no slab is looked for between those that overlap deeply.
bool MotionSearch::touching(std::vector<Suspect>& near, double s) {
  constexpr double kDeep = -0.4;
  const Configuration& c = at(s);
  for (Suspect& pair : near) pair.roots /= std::max(queries_.smallerRadius(pair.pair), 0x1p-500);
  std::sort(near.begin(), near.end(),
            [](const Suspect& a, const Suspect& b) { return a.roots < b.roots; });
  for (Suspect& pair : near) {
    ++counts_.queries;
    if (pair.roots > kDeep && queries_.slab(pair.pair, c, 0) > 0) continue;
    if (!queries_.touching(pair.pair, c)) continue;
    suspects_.assign(1, pair);
    end_ = {MotionVerdict::kContact, s, s, 0};
    return true;
  }
  return false;
}

bool MotionSearch::containedAt(double s) {
  if (!marksExist()) return false;
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
