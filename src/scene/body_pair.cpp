// SPDX-FileCopyrightText: 2026 The fcl_kios authors
// SPDX-License-Identifier: BSD-3-Clause
#include "scene/body_pair.h"

#include <algorithm>
#include <cmath>

#include "query/pair_search.h"
#include "scene/content.h"
#include "volume/error_bounds.h"
#include "volume/rounding.h"

namespace kios::scene {

void countSkipped(PairBound::Source source, SceneCounts& counts) {
  using Source = PairBound::Source;
  ++(source == Source::kStill   ? counts.still
     : source == Source::kRoots ? counts.far_roots
                                : counts.far_boxes);
}

const MeshPair& BodyPair::frame() const {
  if (!frame_) frame_.emplace(a_.content->pairOf(a_, b_));
  return *frame_;
}

double BodyPair::roundingOf(double d) const {
  return error_bounds::triangleError<double>(
             error_bounds::extentOf(d, a_.sphere.radius, b_.sphere.radius)) +
         kUlpFloat * std::abs(d) + kLeastFloat;
}

bool BodyPair::still() const {
  if (!proof_) return false;
  if (proof_->pose_a == a_.pose && proof_->pose_b == b_.pose) return true;
  return meshes() && frame().X_AB.R() == proof_->R && frame().X_AB.T() == proof_->T;
}

PairBound BodyPair::cachedLowerBound(double limit) const {
  using Source = PairBound::Source;
  PairBound known = {-kInfinity, Source::kNothing, false};
  if (still()) {
    if (proof_->exact) return {proof_->distance, Source::kStill, true};
    known = {proof_->apart, Source::kStill, false};
    if (known.bound > limit) return known;
  }
  if (!meshes() || !(limit < kInfinity)) return known;
  const double apart = frame().rootBound(limit + 2 * roundingOf(std::max(limit, 0.0)));
  const double bound = apart - roundingOf(std::max(apart, 0.0));
  if (bound > known.bound) known = {bound, Source::kRoots, false};
  return known;
}

std::optional<BodyPair::Answer> BodyPair::decide(double limit, PairBound& known,
                                                 SceneCounts& counts) const {
  if (lowerBound() > limit) {
    ++counts.ties;
    return Answer();
  }
  known = cachedLowerBound(limit);
  if (known.exact) {
    ++counts.still;
    return proven(limit);
  }
  if (!(known.bound > limit)) return std::nullopt;
  countSkipped(known.source, counts);
  return Answer();
}

double BodyPair::ceiling() const {
  if (!proof_ || !meshes() || proof_->triangle_a < 0 || proof_->triangle_b < 0) return kInfinity;
  const double near =
      frame()
          .distanceOf({static_cast<int>(proof_->triangle_a), static_cast<int>(proof_->triangle_b)})
          .distance;
  return near + 2 * roundingOf(near);
}

BodyPair::Answer BodyPair::proven(double limit) const {
  return {proof_->distance <= limit, proof_->distance, proof_->triangle_a, proof_->triangle_b};
}

void BodyPair::remember(double apart, bool exact, const Answer& answer) {
  if (!lasting()) return;
  Proof* const proof = memory_.obtain(id_a_, id_b_);
  if (!proof) return;
  const bool same = proof->tellsOf(a_, b_);
  proof->generation_a = a_.generation;
  proof->generation_b = b_.generation;
  if (meshes()) {
    proof->R = frame().X_AB.R();
    proof->T = frame().X_AB.T();
  }
  proof->pose_a = a_.pose;
  proof->pose_b = b_.pose;
  proof->apart = apart;
  proof->exact = exact;
  proof->distance = answer.distance;
  // If only a bound was found, the old triangles may still be the nearest.
  if (answer.triangle_a >= 0 || exact || !same) {
    proof->triangle_a = answer.triangle_a;
    proof->triangle_b = answer.triangle_b;
  }
  proof_ = proof;
}

BodyPair::Answer BodyPair::searchMeshes(double limit, bool exact, SearchCounts& counts) {
  const double rounding = roundingOf(std::max(limit, 0.0));
  engine::PairQuery query;
  if (proof_) {
    query.start = {static_cast<int>(proof_->triangle_a), static_cast<int>(proof_->triangle_b)};
  }
  // Above the limit also where all is 0.
  query.far_enough = std::nextafter(limit + 2 * rounding, kInfinity);
  if (!exact) query.near_enough = std::max(0.0, limit - 2 * rounding);
  const DistanceBracketResultd found = bracketDistance(frame(), query);
  counts += found.counts;
  Answer answer = {true, a_.content->rounded(found.distance), found.triangle_a, found.triangle_b};
  if (found.stop == DistanceStop::kTolerance) {
    answer.within = answer.distance <= limit;
    remember(answer.distance, true, answer);
  } else {
    answer.within = found.stop == DistanceStop::kNear;
    const double apart = found.lower_bound;
    remember(apart - roundingOf(apart), false, answer);
  }
  return answer;
}

BodyPair::Answer BodyPair::search(double limit, bool exact, SceneCounts& counts) {
  ++counts.queried;
  const Answer answer = ask(limit, exact, counts.search);
  if (!answer.within) ++counts.proven_farther;
  return answer;
}

BodyPair::Answer BodyPair::answer(double limit, bool exact, SceneCounts& counts) {
  PairBound known;
  if (const std::optional<Answer> decided = decide(limit, known, counts)) return *decided;
  return search(limit, exact, counts);
}

BodyPair::Answer BodyPair::ask(double limit, bool exact, SearchCounts& counts) {
  if (meshes()) {
    const Answer answer = searchMeshes(limit, exact, counts);
    if (!(answer.within && answer.distance == 0) &&
        a_.content->contained(*b_.content, frame(), counts)) {
      const Answer contact = {limit >= 0, 0, -1, -1};
      remember(0, true, contact);
      return contact;
    }
    return answer;
  }
  const ScenePaird found = a_.content->ask(a_, b_, false);
  const Answer answer = {found.distance <= limit, found.distance, found.triangle_a,
                         found.triangle_b};
  remember(-kInfinity, true, answer);
  return answer;
}

void nearestPoints(const Body& a, const Body& b, ScenePaird& pair) {
  if (a.mesh && b.mesh && pair.triangle_a >= 0) {
    const TriangleDistanced nearest = a.content->pairOf(a, b).distanceOf(
        {static_cast<int>(pair.triangle_a), static_cast<int>(pair.triangle_b)});
    pair.nearest_a = toWorld<double>(a.X_W, nearest.point_a);
    pair.nearest_b = toWorld<double>(a.X_W, nearest.point_b);
    return;
  }
  const ScenePaird found = a.content->ask(a, b, true);
  pair.nearest_a = found.nearest_a;
  pair.nearest_b = found.nearest_b;
}

}  // namespace kios::scene
