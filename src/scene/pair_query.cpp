// SPDX-FileCopyrightText: 2026 The fcl_kios authors
// SPDX-License-Identifier: BSD-3-Clause
#include "scene/pair_query.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "fcl_kios/overloads.h"
#include "fcl_kios/query/distance.h"
#include "fcl_kios/query/mesh_queries.h"
#include "fcl_kios/triangle/distance.h"
#include "fcl_kios/volume/separation.h"
#include "query/mesh_pair.h"

namespace kios::scene {
namespace {

constexpr double kInfinity = std::numeric_limits<double>::infinity();

/// |t_b - t_a|_1, which bounds the translation between the bodies' frames.
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
const kIOS<S>& rootOf(const Body<S>& body) {
  return body.model->getBV(0).bv;
}

template <typename S>
TriangleDistance<S> distanceOf(const Body<S>& a, std::intptr_t triangle_a, const Body<S>& b,
                               std::intptr_t triangle_b) {
  const RelativePose<S> X_AB(a.X_W, b.X_W);
  return triangleDistance(cornersOf(*a.model, static_cast<int>(triangle_a)),
                          transformed(cornersOf(*b.model, static_cast<int>(triangle_b)), X_AB));
}

}  // namespace

template <typename S>
PairQuery<S>::PairQuery(int id_a, const Body<S>& a, int id_b, const Body<S>& b,
                        PairMemory<S>& memory)
    : id_a_(id_a),
      id_b_(id_b),
      a_(a),
      b_(b),
      memory_(memory),
      proof_(memory.find(id_a, a, id_b, b)) {}

// 16 eps of the extent of the triangles, which is at most d + 2 r_a + 2 r_b, twice.
template <typename S>
double PairQuery<S>::roundingOf(double d) const {
  constexpr double kEps = std::numeric_limits<S>::epsilon();
  return 32 * kEps * (std::abs(d) + 2 * (a_.sphere.radius + b_.sphere.radius));
}

// At the proof's pose and now, computed distances are off by roundingOf(), and by 8 eps (|y| + |T|)
// from the common frame, y the points of b.
template <typename S>
double PairQuery<S>::afterMotion(double moved, double T_norm) const {
  constexpr double kEps = std::numeric_limits<S>::epsilon();
  const double frames = 16 * kEps * (4 * b_.reach + norm1<S>(proof_->T) + T_norm);
  return proof_->apart - moved * (1 + 0x1p-40) - 2 * roundingOf(proof_->apart) - frames;
}

template <typename S>
Knowledge PairQuery<S>::know(double limit) const {
  using Source = Knowledge::Source;
  Knowledge known = {-kInfinity, Source::kNothing, false};
  const auto raise = [&](double bound, Source source) {
    if (bound > known.bound) known = {bound, source, false};
    return known.bound > limit;
  };
  const auto still = [&] {
    if (proof_->exact) return Knowledge{double{proof_->distance}, Source::kStill, true};
    return Knowledge{proof_->apart, Source::kStill, false};
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

  const RelativePose<S> X_AB(a_.X_W, b_.X_W);
  if (proof_ && known.source != Source::kStill) {
    if (X_AB.R == proof_->R && X_AB.T == proof_->T) {
      known = still();
      if (known.exact || known.bound > limit) return known;
    } else {
      const double moved = displacement<S>(proof_->R, proof_->T, X_AB.R, X_AB.T, b_.sphere);
      if (raise(afterMotion(moved, X_AB.T_norm1), Source::kMotion)) return known;
    }
  }
  const double apart =
      separation(rootOf(a_), rootOf(b_), X_AB, limit + 2 * roundingOf(std::max(limit, 0.0)));
  raise(apart - roundingOf(std::max(apart, 0.0)), Source::kRoots);
  return known;
}

template <typename S>
double PairQuery<S>::upperBound() const {
  if (!proof_ || !meshes() || proof_->triangle_a < 0 || proof_->triangle_b < 0) return kInfinity;
  return distanceOf(a_, proof_->triangle_a, b_, proof_->triangle_b).distance;
}

template <typename S>
double PairQuery<S>::ceiling() const {
  const double near = upperBound();
  return near + 2 * roundingOf(near);
}

template <typename S>
bool PairQuery<S>::stoodStill() const {
  if (!proof_ || !proof_->exact) return false;
  if (proof_->path_a == a_.path && proof_->path_b == b_.path) return true;
  if (!meshes()) return false;
  const RelativePose<S> X_AB(a_.X_W, b_.X_W);
  return X_AB.R == proof_->R && X_AB.T == proof_->T;
}

template <typename S>
typename PairQuery<S>::Answer PairQuery<S>::nearby(double limit) const {
  const double distance = upperBound();
  if (!(distance + 2 * roundingOf(distance) <= limit)) return {};
  return {true, static_cast<S>(distance), proof_->triangle_a, proof_->triangle_b};
}

template <typename S>
typename PairQuery<S>::Answer PairQuery<S>::proven(double limit) const {
  return {proof_->distance <= limit, proof_->distance, proof_->triangle_a, proof_->triangle_b};
}

template <typename S>
void PairQuery<S>::remember(double apart, bool exact, const Answer& answer) {
  Proof<S>* const proof = memory_.obtain(id_a_, id_b_);
  if (!proof) return;
  const bool same = proof->tellsOf(a_, b_);
  const RelativePose<S> X_AB(a_.X_W, b_.X_W);
  proof->state_a = a_.state;
  proof->state_b = b_.state;
  proof->R = X_AB.R;
  proof->T = X_AB.T;
  proof->path_a = a_.path;
  proof->path_b = b_.path;
  proof->rotation_error = a_.rotation_error;
  proof->apart = apart;
  proof->exact = exact;
  proof->distance = answer.distance;
  if (answer.triangle_a >= 0 || !same) {  // else the old triangles may still be the nearest
    proof->triangle_a = answer.triangle_a;
    proof->triangle_b = answer.triangle_b;
  }
  proof->made = memory_.query();
  proof_ = proof;
}

// A pair that turns out farther than asked is asked again as soon as it moves, or the limit grows.
// So it is asked about a little more: what it may come nearer in the next few queries, unless that
// is much for its size, and a share of the limit.
template <typename S>
double PairQuery<S>::outlook(double limit) const {
  constexpr double kQueries = 8, kSizeShare = 0.05, kLimitShare = 1.0 / 32;
  const double ahead = kLimitShare * std::max(limit, 0.0);
  if (!proof_ || proof_->made == memory_.query()) return ahead;
  const RelativePose<S> X_AB(a_.X_W, b_.X_W);
  const double moved = displacement<S>(proof_->R, proof_->T, X_AB.R, X_AB.T, b_.sphere);
  const double nearer = kQueries * moved / static_cast<double>(memory_.query() - proof_->made);
  return nearer < kSizeShare * (a_.sphere.radius + b_.sphere.radius) ? ahead + nearer : ahead;
}

template <typename S>
typename PairQuery<S>::Answer PairQuery<S>::searchMeshes(double limit, SearchCounts& counts) {
  constexpr S kMax = std::numeric_limits<S>::max();
  const double wanted = limit + 2 * roundingOf(std::max(limit, 0.0)) + outlook(limit);
  for (const double at_most : {std::min(wanted, ceiling()), wanted}) {
    const fcl::DistanceRequest<S> request;
    fcl::DistanceResult<S> result;
    // Above the limit also where all is 0, or S rounds it down.
    if (at_most < kMax) result.min_distance = std::nextafter(static_cast<S>(at_most), kMax);
    distanceMeshes(*a_.model, a_.X_W, *b_.model, b_.X_W, request, result, &counts);
    if (result.o1) {
      const Answer answer = {result.min_distance <= limit, result.min_distance, result.b1,
                             result.b2};
      remember(double{answer.distance}, true, answer);
      return answer;
    }
    if (!(at_most < wanted)) break;  // else the ceiling was not one, which it always is
  }
  remember(wanted - roundingOf(wanted), false, {});
  return {};
}

template <typename S>
typename PairQuery<S>::Answer PairQuery<S>::decideMeshes(double limit, SearchCounts& counts) {
  constexpr S kMax = std::numeric_limits<S>::max();
  const double rounding = roundingOf(std::max(limit, 0.0));
  WarmStart start;
  if (proof_) {
    start = {static_cast<int>(proof_->triangle_a), static_cast<int>(proof_->triangle_b)};
  }
  DistanceOptions<S> options;
  options.nearest_points = false;
  options.warm_start = &start;
  const double far = limit + 2 * rounding + outlook(limit);
  if (far < kMax) options.far_enough = std::nextafter(static_cast<S>(far), kMax);
  options.near_enough = static_cast<S>(std::max(0.0, limit - 2 * rounding));

  const DistanceAnswer<S> found = kios::distance(*a_.model, a_.X_W, *b_.model, b_.X_W, options);
  counts += found.counts;
  Answer answer = {true, found.distance, found.triangle1, found.triangle2};
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
typename PairQuery<S>::Answer PairQuery<S>::search(double limit, bool exact, SearchCounts& counts) {
  if (meshes()) return exact ? searchMeshes(limit, counts) : decideMeshes(limit, counts);
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
  if (a.model && b.model) {
    const TriangleDistance<S> nearest = distanceOf(a, pair.triangle_a, b, pair.triangle_b);
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

#define KIOS_INSTANTIATE(S)    \
  template class PairQuery<S>; \
  template void nearestPoints(const Body<S>&, const Body<S>&, ScenePair<S>&);
KIOS_INSTANTIATE(double)
KIOS_INSTANTIATE(float)
#undef KIOS_INSTANTIATE

}  // namespace kios::scene
