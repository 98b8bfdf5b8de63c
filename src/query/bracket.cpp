// SPDX-FileCopyrightText: 2026 The fcl_kios authors
// SPDX-License-Identifier: BSD-3-Clause
#include "query/bracket.h"

#include <algorithm>

#include "query/pair_search.h"
#include "volume/rounding.h"

namespace kios {
namespace {

/// Sets what was proven, with all rounding paid for.
template <typename S>
void setBounds(const MeshPair<S>& frame, const engine::PairAnswer<S>& found,
               DistanceAnswer<S>& answer) {
  double lower = found.least_other;
  if (found.least_evaluated < kInfinity) {
    const double error = frame.distanceError(found.least_evaluated);
    lower = std::min(lower, std::max({0.0, found.least_evaluated - error, found.proven_evaluated}));
  }
  if (found.found()) {
    answer.distance = found.nearest.distance;
    answer.upper_bound = roundUp<S>(double{answer.distance} + frame.distanceErrorOf(found.ids));
    answer.triangle_a = found.ids.a;
    answer.triangle_b = found.ids.b;
    answer.point_a = found.nearest.point_a;
    answer.point_b = found.nearest.point_b;
    lower = std::min(lower, double{answer.distance});
  }
  answer.lower_bound = std::max(answer.lower_bound, roundDown<S>(lower));
}

}  // namespace

template <typename S>
DistanceAnswer<S> bracketDistance(const MeshPair<S>& frame, const engine::PairQuery& query) {
  DistanceAnswer<S> answer;
  if (query.far_enough <= 0) {
    answer.stop = DistanceStop::kFar;
    return answer;
  }
  double roots = 0;
  if (query.far_enough < kInfinity || query.hasBudget()) {
    roots = frame.rootBound(std::min(query.far_enough, 0x1p1000));
    answer.lower_bound = roundDown<S>(std::max(0.0, roots));
    if (double{answer.lower_bound} >= query.far_enough) {
      answer.stop = DistanceStop::kFar;
      return answer;
    }
  }
  return bracketDistance(frame, query, roots);
}

template <typename S>
DistanceAnswer<S> bracketDistance(const MeshPair<S>& frame, const engine::PairQuery& query,
                                  double roots) {
  DistanceAnswer<S> answer;
  answer.lower_bound = roundDown<S>(std::max(0.0, roots));
  const engine::PairAnswer<S> found = searchNearest(frame, query, answer.counts);
  setBounds(frame, found, answer);
  if (answer.distance == 0) {
    answer.stop = DistanceStop::kTolerance;
  } else if (found.end == engine::SearchEnd::kNear) {
    answer.stop = DistanceStop::kNear;
  } else if (double{answer.lower_bound} >= query.far_enough) {
    answer.stop = DistanceStop::kFar;
  } else if (found.end == engine::SearchEnd::kBudget) {
    answer.stop = DistanceStop::kBudget;
  } else if (double{answer.distance} > query.far_enough) {
    // Within rounding of far_enough neither this is proven nor all that is nearer than the answer
    // was looked at: a search without it decides. With a budget the bracket stands as it is.
    if (query.hasBudget()) {
      answer.stop = DistanceStop::kBudget;
    } else {
      engine::PairQuery unlimited = query;
      unlimited.far_enough = kInfinity;
      const SearchCounts before = answer.counts;
      answer = bracketDistance(frame, unlimited);
      answer.counts += before;
    }
  }
  return answer;
}

template DistanceAnswerd bracketDistance(const MeshPair<double>&, const engine::PairQuery&);
template DistanceAnswerf bracketDistance(const MeshPair<float>&, const engine::PairQuery&);
template DistanceAnswerd bracketDistance(const MeshPair<double>&, const engine::PairQuery&, double);
template DistanceAnswerf bracketDistance(const MeshPair<float>&, const engine::PairQuery&, double);

}  // namespace kios
