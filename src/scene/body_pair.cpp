// SPDX-FileCopyrightText: 2026 The fcl_kios authors
// SPDX-License-Identifier: BSD-3-Clause
#include "scene/body_pair.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include <fcl/narrowphase/distance_request.h>
#include <fcl/narrowphase/distance_result.h>
#include "fcl_kios/overloads.h"
#include "query/bracket.h"
#include "query/pair_search.h"
#include "solid/containment.h"
#include "solid/solid_mark.h"
#include "volume/error_bounds.h"
#include "volume/instantiate.h"
#include "volume/rounding.h"

namespace kios::scene {
namespace {

/// Returns |t_b - t_a|_1, which bounds the translation between the bodies' frames.
template <typename S>
double translation(const Body<S>& a, const Body<S>& b) {
  double sum = 0;
  for (int i = 0; i < 3; ++i) {
    sum += std::abs(double{b.X_W.translation()[i]} - double{a.X_W.translation()[i]});
  }
  return sum;
}

template <typename S>
double norm1(const fcl::Vector3<S>& v) {
  return std::abs(double{v[0]}) + std::abs(double{v[1]}) + std::abs(double{v[2]});
}

template <typename S>
MeshPair<S> frameOf(const Body<S>& a, const Body<S>& b) {
  return {*a.model, a.X_W, *b.model, b.X_W, a.rotation_square + b.rotation_square};
}

}  // namespace

void countSkipped(PairBound::Source source, SceneCounts& counts) {
  using Source = PairBound::Source;
  ++(source == Source::kStill    ? counts.still
     : source == Source::kMotion ? counts.moved_too_little
     : source == Source::kRoots  ? counts.far_roots
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
const MeshPair<S>& BodyPair<S>::frame() const {
  if (!frame_) frame_.emplace(frameOf(a_, b_));
  return *frame_;
}

template <typename S>
double BodyPair<S>::roundingOf(double d) const {
  return error_bounds::triangleError<S>(
      error_bounds::extentOf(d, a_.sphere.radius, b_.sphere.radius));
}

// At the proof's pose and now, computed distances are off by roundingOf(), and by the common
// frame's rounding of b's points.
template <typename S>
double BodyPair<S>::afterMotion(double moved, double T_norm1) const {
  const double reach1 = 2 * b_.reach;  // |x|_1 <= sqrt(3) |x|_2
  const double frames = error_bounds::frameError<S>(reach1, norm1<S>(proof_->T)) +
                        error_bounds::frameError<S>(reach1, T_norm1);
  return proof_->apart - moved * (1 + 0x1p-40) - 2 * roundingOf(proof_->apart) - frames;
}

template <typename S>
PairBound BodyPair<S>::cachedLowerBound(double limit) const {
  using Source = PairBound::Source;
  PairBound known = {-kInfinity, Source::kNothing, false};
  const auto raise = [&](double bound, Source source) {
    if (bound > known.bound) known = {bound, source, false};
    return known.bound > limit;
  };
  const auto still = [&] {
    if (proof_->exact) return PairBound{double{proof_->distance}, Source::kStill, true};
    return PairBound{proof_->apart, Source::kStill, false};
  };

  if (proof_) {
    if (proof_->path_a == a_.path && proof_->path_b == b_.path) {
      known = still();
      if (known.exact || known.bound > limit) return known;
    } else if (meshes()) {
      // Both have moved in the world by at most their paths, and a's frame sees the world through a
      // rotation that is off by its error: (1 - e)(g - e x) and the like, x a point of a.
      const double moved = addUp(addUp(a_.path, -proof_->path_a), addUp(b_.path, -proof_->path_b));
      const double skew =
          (proof_->rotation_error + a_.rotation_error) * (a_.reach + std::abs(proof_->apart));
      if (raise(afterMotion(moved, translation(a_, b_)) - 1.01 * skew, Source::kMotion)) {
        return known;
      }
    }
  }
  if (!meshes()) return known;

  const RelativePose<S>& X_AB = frame().X_AB;
  if (proof_ && known.source != Source::kStill) {
    if (X_AB.R() == proof_->R && X_AB.T() == proof_->T) {
      known = still();
      if (known.exact || known.bound > limit) return known;
    } else {
      const double moved = displacement<S>(proof_->R, proof_->T, X_AB.R(), X_AB.T(), b_.sphere);
      if (raise(afterMotion(moved, detail::boundsOf(X_AB).T_norm1), Source::kMotion)) return known;
    }
  }
  const double apart = frame().rootBound(limit + 2 * roundingOf(std::max(limit, 0.0)));
  raise(apart - roundingOf(std::max(apart, 0.0)), Source::kRoots);
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
double BodyPair<S>::upperBound() const {
  if (!proof_ || !meshes() || proof_->triangle_a < 0 || proof_->triangle_b < 0) return kInfinity;
  return frame()
      .distanceOf({static_cast<int>(proof_->triangle_a), static_cast<int>(proof_->triangle_b)})
      .distance;
}

template <typename S>
double BodyPair<S>::ceiling() const {
  const double near = upperBound();
  return near + 2 * roundingOf(near);
}

template <typename S>
bool BodyPair<S>::stoodStill() const {
  if (!proof_ || !proof_->exact) return false;
  if (proof_->path_a == a_.path && proof_->path_b == b_.path) return true;
  if (!meshes()) return false;
  const RelativePose<S>& X_AB = frame().X_AB;
  return X_AB.R() == proof_->R && X_AB.T() == proof_->T;
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
  proof->path_a = a_.path;
  proof->path_b = b_.path;
  proof->rotation_error = a_.rotation_error;
  proof->apart = apart;
  proof->exact = exact;
  proof->distance = answer.distance;
  // If only a bound was found, the old triangles may still be the nearest.
  if (answer.triangle_a >= 0 || exact || !same) {
    proof->triangle_a = answer.triangle_a;
    proof->triangle_b = answer.triangle_b;
  }
  proof->made = memory_.query();
  proof_ = proof;
}

// A pair that is proven farther than the limit is searched again as soon as it moves, or the limit
// grows. So the search goes a little beyond the limit: by the way that the pair may come nearer in
// the next few queries, unless that is much for its size, and by a share of the limit.
template <typename S>
double BodyPair<S>::outlook(double limit) const {
  constexpr double kQueries = 8, kSizeShare = 0.05, kLimitShare = 1.0 / 32;
  const double ahead = kLimitShare * std::max(limit, 0.0);
  if (!proof_ || proof_->made == memory_.query()) return ahead;
  const RelativePose<S>& X_AB = frame().X_AB;
  const double moved = displacement<S>(proof_->R, proof_->T, X_AB.R(), X_AB.T(), b_.sphere);
  const double nearer = kQueries * moved / static_cast<double>(memory_.query() - proof_->made);
  return nearer < kSizeShare * (a_.sphere.radius + b_.sphere.radius) ? ahead + nearer : ahead;
}

template <typename S>
typename BodyPair<S>::Answer BodyPair<S>::searchMeshes(double limit, SearchCounts& counts) {
  constexpr S kMax = std::numeric_limits<S>::max();
  const double wanted = limit + 2 * roundingOf(std::max(limit, 0.0)) + outlook(limit);
  for (const double at_most : {std::min(wanted, ceiling()), wanted}) {
    engine::PairQuery query;
    // Above the limit also where all is 0, or S rounds it down.
    if (at_most < kMax) query.far_enough = std::nextafter(static_cast<S>(at_most), kMax);
    if (frame().rootBound(query.far_enough) < query.far_enough) {
      const engine::PairAnswer<S> found = searchNearest(frame(), query, counts);
      const S distance = found.nearest.distance;
      if (found.found() && distance < query.far_enough) {
        const Answer answer = {distance <= limit, distance, found.ids.a, found.ids.b};
        remember(double{distance}, true, answer);
        return answer;
      }
    }
    if (!(at_most < wanted)) break;  // else the ceiling was not one, which it always is
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
  query.far_enough = std::nextafter(limit + 2 * rounding + outlook(limit), kInfinity);
  query.near_enough = std::max(0.0, limit - 2 * rounding);

  const DistanceAnswer<S> found = bracketDistance(frame(), query);
  counts += found.counts;
  Answer answer = {true, found.distance, found.triangle_a, found.triangle_b};
  if (found.stop == DistanceStop::kTolerance) {
    answer.within = found.distance <= limit;
    remember(double{found.distance}, true, answer);
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
  return containedPoint(frame(), counts).has_value();
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
  if (!exact) {
    const double near = upperBound();
    if (near + 2 * roundingOf(near) <= limit) {
      ++counts.near_by_proof;
      return {true, static_cast<S>(near), proof_->triangle_a, proof_->triangle_b};
    }
  }
  return search(limit, exact, counts);
}

template <typename S>
typename BodyPair<S>::Answer BodyPair<S>::ask(double limit, bool exact, SearchCounts& counts) {
  if (meshes()) {
    const Answer answer = exact ? searchMeshes(limit, counts) : decideMeshes(limit, counts);
    if (marksExist() && !(answer.within && answer.distance == 0) && contained(counts)) {
      const Answer contact = {limit >= 0, S(0), -1, -1};
      remember(0, true, contact);
      return contact;
    }
    return answer;
  }
  const fcl::DistanceRequest<S> request;
  fcl::DistanceResult<S> result;
  const S distance =
      fcl::distance(a_.geometry.get(), a_.X_W, b_.geometry.get(), b_.X_W, request, result);
  const Answer answer = {distance <= limit, distance, result.b1, result.b2};
  remember(-kInfinity, true, answer);
  return answer;
}

template <typename S>
void nearestPoints(const Body<S>& a, const Body<S>& b, ScenePair<S>& pair) {
  if (a.model && b.model && pair.triangle_a >= 0) {
    const TriangleDistance<S> nearest = frameOf(a, b).distanceOf(
        {static_cast<int>(pair.triangle_a), static_cast<int>(pair.triangle_b)});
    pair.nearest_a = a.X_W * nearest.point_a;
    pair.nearest_b = a.X_W * nearest.point_b;
    return;
  }
  const fcl::DistanceRequest<S> request(true);
  fcl::DistanceResult<S> result;
  fcl::distance(a.geometry.get(), a.X_W, b.geometry.get(), b.X_W, request, result);
  pair.nearest_a = result.nearest_points[0];
  pair.nearest_b = result.nearest_points[1];
}

KIOS_INSTANTIATE_CLASS(BodyPair);
KIOS_INSTANTIATE_FUNCTION(nearestPoints);

}  // namespace kios::scene
