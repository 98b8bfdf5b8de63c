// SPDX-FileCopyrightText: 2026 The fcl_kios authors
// SPDX-License-Identifier: BSD-3-Clause
#include "scene/body_pair.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "fcl/dispatch.h"
#include "query/pair_search.h"
#include "solid/containment.h"
#include "solid/solid_mark.h"
#include "volume/error_bounds.h"
#include "volume/instantiate.h"
#include "volume/rounding.h"

namespace kios::scene {
namespace {

template <typename S>
MeshPair frameOf(const Body<S>& a, const Body<S>& b) {
  return {meshOf(*a.model), a.X_W, meshOf(*b.model), b.X_W, a.rotation_square + b.rotation_square};
}

}  // namespace

void countSkipped(PairBound::Source source, SceneCounts& counts) {
  using Source = PairBound::Source;
  ++(source == Source::kStill   ? counts.still
     : source == Source::kRoots ? counts.far_roots
                                : counts.far_boxes);
}

template <typename S>
BodyPair<S>::BodyPair(int id_a, const Body<S>& a, int id_b, const Body<S>& b, PairMemory<S>& memory)
    : id_a_(id_a),
      id_b_(id_b),
      a_(a),
      b_(b),
      memory_(memory),
      proof_(lasting() ? memory.find(id_a, a, id_b, b) : nullptr) {}

template <typename S>
const MeshPair& BodyPair<S>::frame() const {
  if (!frame_) frame_.emplace(frameOf(a_, b_));
  return *frame_;
}

template <typename S>
double BodyPair<S>::roundingOf(double d) const {
  return error_bounds::triangleError<S>(
      error_bounds::extentOf(d, a_.sphere.radius, b_.sphere.radius));
}

template <typename S>
bool BodyPair<S>::still() const {
  if (!proof_) return false;
  if (proof_->pose_a == a_.pose && proof_->pose_b == b_.pose) return true;
  return meshes() && frame().X_AB.R() == proof_->R && frame().X_AB.T() == proof_->T;
}

template <typename S>
PairBound BodyPair<S>::cachedLowerBound(double limit) const {
  using Source = PairBound::Source;
  PairBound known = {-kInfinity, Source::kNothing, false};
  if (still()) {
    if (proof_->exact) return {double{proof_->distance}, Source::kStill, true};
    known = {proof_->apart, Source::kStill, false};
    if (known.bound > limit) return known;
  }
  if (!meshes()) return known;
  const double apart = frame().rootBound(limit + 2 * roundingOf(std::max(limit, 0.0)));
  const double bound = apart - roundingOf(std::max(apart, 0.0));
  if (bound > known.bound) known = {bound, Source::kRoots, false};
  return known;
}

template <typename S>
std::optional<typename BodyPair<S>::Answer> BodyPair<S>::decide(double limit, PairBound& known,
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

template <typename S>
double BodyPair<S>::ceiling() const {
  if (!proof_ || !meshes() || proof_->triangle_a < 0 || proof_->triangle_b < 0) return kInfinity;
  const double near =
      frame()
          .distanceOf({static_cast<int>(proof_->triangle_a), static_cast<int>(proof_->triangle_b)})
          .distance;
  return near + 2 * roundingOf(near);
}

template <typename S>
typename BodyPair<S>::Answer BodyPair<S>::proven(double limit) const {
  return {proof_->distance <= limit, proof_->distance, proof_->triangle_a, proof_->triangle_b};
}

template <typename S>
void BodyPair<S>::remember(double apart, bool exact, const Answer& answer) {
  if (!lasting()) return;
  Proof<S>* const proof = memory_.obtain(id_a_, id_b_);
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

template <typename S>
typename BodyPair<S>::Answer BodyPair<S>::searchMeshes(double limit, SearchCounts& counts) {
  constexpr S kMax = std::numeric_limits<S>::max();
  const double wanted = limit + 2 * roundingOf(std::max(limit, 0.0));
  engine::PairQuery query;
  if (proof_) {
    query.start = {static_cast<int>(proof_->triangle_a), static_cast<int>(proof_->triangle_b)};
  }
  // Above the limit also where all is 0, or S rounds it down.
  if (wanted < kMax) query.far_enough = std::nextafter(roundedTo<S>(wanted), kMax);
  const engine::PairAnswer found = searchNearest(frame(), query, counts);
  if (found.found() && found.nearest.distance < query.far_enough) {
    const S distance = roundedLength<S>(found.nearest.distance);
    const Answer answer = {distance <= limit, distance, found.ids.a, found.ids.b};
    remember(double{distance}, true, answer);
    return answer;
  }
  remember(wanted - roundingOf(wanted), false, {});
  return {};
}

template <typename S>
typename BodyPair<S>::Answer BodyPair<S>::decideMeshes(double limit, SearchCounts& counts) {
  const double rounding = roundingOf(std::max(limit, 0.0));
  engine::PairQuery query;
  if (proof_) {
    query.start = {static_cast<int>(proof_->triangle_a), static_cast<int>(proof_->triangle_b)};
  }
  // Above the limit also where all is 0.
  query.far_enough = std::nextafter(limit + 2 * rounding, kInfinity);
  query.near_enough = std::max(0.0, limit - 2 * rounding);

  const DistanceAnswerd found = bracketDistance(frame(), query);
  counts += found.counts;
  Answer answer = {true, roundedLength<S>(found.distance), found.triangle_a, found.triangle_b};
  if (found.stop == DistanceStop::kTolerance) {
    answer.within = answer.distance <= limit;
    remember(double{answer.distance}, true, answer);
  } else {
    answer.within = found.stop == DistanceStop::kNear;
    const double apart = found.lower_bound;
    remember(apart - roundingOf(apart), false, answer);
  }
  return answer;
}

template <typename S>
bool BodyPair<S>::contained(SearchCounts& counts) const {
  if (!areSolids(*a_.model, *b_.model) || frame().rootBound(0) > 0) return false;
  return containedPoint(*a_.model, *b_.model, frame(), counts).has_value();
}

template <typename S>
typename BodyPair<S>::Answer BodyPair<S>::search(double limit, bool exact, SceneCounts& counts) {
  ++counts.queried;
  const Answer answer = ask(limit, exact, counts.search);
  if (!answer.within) ++counts.proven_farther;
  return answer;
}

template <typename S>
typename BodyPair<S>::Answer BodyPair<S>::answer(double limit, bool exact, SceneCounts& counts) {
  PairBound known;
  if (const std::optional<Answer> decided = decide(limit, known, counts)) return *decided;
  return search(limit, exact, counts);
}

template <typename S>
typename BodyPair<S>::Answer BodyPair<S>::ask(double limit, bool exact, SearchCounts& counts) {
  if (meshes()) {
    const Answer answer = exact ? searchMeshes(limit, counts) : decideMeshes(limit, counts);
    if (!(answer.within && answer.distance == 0) && contained(counts)) {
      const Answer contact = {limit >= 0, S(0), -1, -1};
      remember(0, true, contact);
      return contact;
    }
    return answer;
  }
  const fcl::DistanceResult<S> found =
      distanceOfAny(*a_.geometry, a_.X_W, *b_.geometry, b_.X_W, false);
  const Answer answer = {found.min_distance <= limit, found.min_distance, found.b1, found.b2};
  remember(-kInfinity, true, answer);
  return answer;
}

template <typename S>
void nearestPoints(const Body<S>& a, const Body<S>& b, ScenePair<S>& pair) {
  if (a.model && b.model && pair.triangle_a >= 0) {
    const TriangleDistanced nearest = frameOf(a, b).distanceOf(
        {static_cast<int>(pair.triangle_a), static_cast<int>(pair.triangle_b)});
    pair.nearest_a = toWorld<S>(a.X_W, nearest.point_a);
    pair.nearest_b = toWorld<S>(a.X_W, nearest.point_b);
    return;
  }
  const fcl::DistanceResult<S> found = distanceOfAny(*a.geometry, a.X_W, *b.geometry, b.X_W, true);
  pair.nearest_a = found.nearest_points[0];
  pair.nearest_b = found.nearest_points[1];
}

KIOS_INSTANTIATE_CLASS(BodyPair);
KIOS_INSTANTIATE_FUNCTION(nearestPoints);

}  // namespace kios::scene
