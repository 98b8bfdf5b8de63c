// SPDX-FileCopyrightText: 2026 The fcl_kios authors
// SPDX-License-Identifier: BSD-3-Clause
#include "fcl_kios/distance.h"

#include <algorithm>
#include <cmath>

#include "model/prepared.h"
#include "query/pair_search.h"
#include "volume/errors.h"
#include "volume/instantiate.h"
#include "volume/rounding.h"

namespace kios {
namespace {

template <typename S>
void requireValid(const DistanceBracketRequest<S>& o) {
  require(o.rel_err >= 0, "DistanceBracketRequest::rel_err", o.rel_err, ">= 0");
  require(o.abs_err >= 0, "DistanceBracketRequest::abs_err", o.abs_err, ">= 0");
  require(!std::isnan(o.far_enough), "DistanceBracketRequest::far_enough", o.far_enough,
          "a number");
  require(!std::isnan(o.near_enough), "DistanceBracketRequest::near_enough", o.near_enough,
          "a number");
  require(o.max_expansions >= 0, "DistanceBracketRequest::max_expansions", o.max_expansions,
          ">= 0");
}

template <typename S>
engine::PairQuery queryOf(const DistanceBracketRequest<S>& options) {
  engine::PairQuery query;
  query.rel_err = options.rel_err;
  query.abs_err = options.abs_err;
  query.near_enough = options.near_enough;
  query.far_enough = roundsDownTo<S>(options.far_enough);  // lower_bound is to be at least that
  query.max_expansions = options.max_expansions;
  if (options.warm_start)
    query.start = {options.warm_start->triangle_a, options.warm_start->triangle_b};
  return query;
}

template <typename S>
DistanceBracketResult<S> inScalar(const DistanceBracketResultd& answer) {
  DistanceBracketResult<S> rounded;
  rounded.distance = roundedLength<S>(answer.distance);
  rounded.lower_bound = roundDown<S>(answer.lower_bound);
  rounded.upper_bound = roundUp<S>(answer.upper_bound);
  rounded.triangle_a = answer.triangle_a;
  rounded.triangle_b = answer.triangle_b;
  rounded.stop = answer.stop;
  rounded.counts = answer.counts;
  return rounded;
}

}  // namespace

template <typename S>
DistanceBracketResult<S> distanceBracket(const Model<S>& a, const fcl::Transform3<S>& X_WA,
                                         const Model<S>& b, const fcl::Transform3<S>& X_WB,
                                         const DistanceBracketRequest<S>& options) {
  requireValid(options);
  const MeshPair frame(meshOf(a), X_WA, meshOf(b), X_WB);
  const DistanceBracketResultd found = bracketDistance(frame, queryOf(options));
  auto answer = inScalar<S>(found);
  if (answer.triangle_a < 0) return answer;
  if (options.warm_start) *options.warm_start = {answer.triangle_a, answer.triangle_b};
  if (options.nearest_points) {
    answer.point_a = toWorld<S>(X_WA, found.point_a);
    answer.point_b = toWorld<S>(X_WA, found.point_b);
  }
  return answer;
}

// Within distanceError() of t, and within its rounding to S, an exact answer decides. Farther from
// it no rounding can part this verdict from the exact answer's: the pair that realises that is not
// farther than the pair found here, and not nearer than what was proven, by more than
// distanceError().
template <typename S>
bool closerThan(const Model<S>& a, const fcl::Transform3<S>& X_WA, const Model<S>& b,
                const fcl::Transform3<S>& X_WB, std::common_type_t<S> t,
                std::common_type_t<DistanceBracketResult<S>>* certificate, WarmStart* warm_start) {
  require(!std::isnan(t), "the distance asked for", t, "a number");
  const MeshPair frame(meshOf(a), X_WA, meshOf(b), X_WB);
  DistanceBracketResultd answer;
  const auto decided = [&](bool closer) {
    if (certificate) *certificate = inScalar<S>(answer);
    return closer;
  };
  if (t < 0) {
    answer.stop = DistanceStop::kFar;
    return decided(false);
  }
  if (t == 0 && !certificate && !warm_start) {  // as the distance is 0 where triangles intersect
    return !searchContacts(frame, 1, answer.counts).empty();
  }
  DistanceBracketRequest<S> options;
  options.warm_start = warm_start;
  engine::PairQuery query = queryOf(options);
  const double error = frame.distanceError(t);
  query.near_enough = t < kInfinity ? t - error : t;
  query.far_enough = roundsDownTo<S>(t + 2 * error);
  const auto ask = [&](const engine::PairQuery& question) {
    const SearchCounts before = answer.counts;
    answer = bracketDistance(frame, question);
    answer.counts += before;
    if (answer.triangle_a >= 0 && warm_start) *warm_start = {answer.triangle_a, answer.triangle_b};
  };
  ask(query);
  const bool far = answer.stop == DistanceStop::kFar;
  const bool near = answer.distance == 0 || answer.distance <= query.near_enough;
  if (!far && !near) ask(queryOf(options));
  return decided(!far && (near || roundedLength<S>(answer.distance) <= t));
}

KIOS_INSTANTIATE_FUNCTION(distanceBracket);
KIOS_INSTANTIATE_FUNCTION(closerThan);

}  // namespace kios
