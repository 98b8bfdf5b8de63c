// SPDX-FileCopyrightText: 2026 The fcl_kios authors
// SPDX-License-Identifier: BSD-3-Clause
#include <algorithm>
#include <cmath>

#include "query/few_triangles.h"
#include "query/nearest_candidates.h"
#include "query/placed_triangles.h"
#include "triangle/known_distance.h"
#include "volume/error_bounds.h"
#include "volume/instantiate.h"
#include "volume/rounding.h"

namespace kios {
namespace {

/// Returns a lower bound of the distance of two triangles by a slab between them, across `normal`,
/// which is a unit vector but for 4 u. Heights are those of differences within the pair, so that
/// each is off by 8 u of its extent: one rounding of the difference, three of products and sums,
/// four of the normal. 4 eps of a height are added, so that triangles which share the nearest
/// vertex get no less than its distance: no bound is too large by more than 12 eps of the extent.
template <typename S>
double slabBetween(const TriangleVertices<S>& p, const TriangleVertices<S>& q,
                   const Eigen::Vector3d& normal) {
  const Eigen::Vector3d origin = p[0].template cast<double>();
  const auto height = [&](const Point<S>& x) {
    return detail::dot<double>(normal, x.template cast<double>() - origin);
  };
  const double p1 = height(p[1]), p2 = height(p[2]);
  const double q0 = height(q[0]), q1 = height(q[1]), q2 = height(q[2]);
  const double low = std::min(std::min(q0, q1), q2);
  return low - std::max(std::max(p1, p2), 0.0) + 8 * error_bounds::kUlp<S> * std::abs(low);
}

template <typename S>
engine::PairAnswer<S> noAnswer() {
  engine::PairAnswer<S> answer;
  answer.nearest.point_a = answer.nearest.point_b = Point<S>::Zero();
  return answer;
}

/// The answer where these triangles touch. Their common point takes as long as the rest.
template <typename S>
engine::PairAnswer<S> touchingAnswer(const PlacedPair<S>& pair, const engine::PairQuery& query,
                                     const engine::TrianglePairIds& ids) {
  auto answer = noAnswer<S>();
  answer.ids = ids;
  answer.least_evaluated = 0;
  if (!query.any_touching) {
    answer.nearest = touchingDistance(pair.a.triangle(ids.a), pair.b.triangle(ids.b));
  }
  return answer;
}

}  // namespace

// The pair of the least bound comes next: that of the boxes, or of a slab across the line between
// the nearest points so far. A pair is left out if its bound exceeds the least distance by more
// than rounding may: kernelError() is 16 eps of any pair's extent. One of greater ids than those
// that are nearest, such as another at their vertex, is left out where it is nearer by no more than
// what the slab is off by, 12 eps; the contract is 16. Which of these is named depends on the
// order, and so not on what is far enough, but that it may leave out all.
template <typename S>
engine::PairAnswer<S> nearestPairByPair(const MeshPair<S>& frame, const engine::PairQuery& query,
                                        SearchCounts& counts) {
  const PlacedPair<S> placed(frame);
  const int num_a = placed.a.size(), num_b = placed.b.size();
  // Lengths whose squares over- or underflow bound nothing.
  const auto isSquare = [](double v) { return v > 0x1p-1000 && v < 0x1p1000; };
  const auto isLength = [](double v) { return v > 0x1p-500 && v < 0x1p500; };
  double squares[kMostPairByPair], least_square = kInfinity;
  double* square = squares;
  Sides upper_b[kFewTriangles];
  for (int j = 0; j < num_b; ++j) upper_b[j] = placed.b.box(j).upper();
  for (int i = 0; i < num_a; ++i) {
    const Sides lower = placed.a.box(i).lower();
    for (int j = 0; j < num_b; ++j) {
      const double apart = squaredDistance(lower, upper_b[j]);
      *square = isSquare(apart) ? apart : 0;
      least_square = std::min(least_square, *square++);
    }
  }
  counts.leaf_pairs += num_a * num_b;
  if (least_square == 0) {  // else no boxes touch
    const engine::TrianglePairIds touching = firstIntersecting(placed, counts);
    if (touching.a >= 0) return touchingAnswer(placed, query, touching);
  }
  struct Bounded {
    double bound;
    engine::TrianglePairIds ids;
  } pairs[kMostPairByPair];
  Bounded* end = pairs;
  auto answer = noAnswer<S>();
  double best = kInfinity, error = 0, left_out = kInfinity;
  const auto isLeftOut = [&](const Bounded& pair) {
    const bool later = answer.found() && answer.ids < pair.ids;
    if (!(pair.bound >= (later ? best : best + 2 * error))) return false;
    left_out = std::min(left_out, pair.bound);
    return true;
  };
  const auto leastOther = [&] {  // as given; the larger bound is the larger with its error, too
    return left_out < kInfinity ? std::max(0.0, left_out - frame.distanceError(left_out))
                                : kInfinity;
  };
  // Whether they are the nearest so far.
  const auto evaluate = [&](const engine::TrianglePairIds& ids) {
    ++counts.exact;
    const auto found = disjointDistance(placed.a.triangle(ids.a), placed.b.triangle(ids.b));
    const double d = double{found.distance};
    if (answer.found() && (d > best || (d == best && answer.ids < ids))) return false;
    answer.ids = ids;
    answer.nearest = found;
    answer.least_evaluated = best = d;
    error = frame.kernelError(d);
    return true;
  };
  if (query.far_enough < kInfinity) {
    best = query.far_enough;
    error = frame.distanceError(best);
    if (isLeftOut({std::sqrt(least_square), {}})) {
      answer.least_other = leastOther();
      return answer;
    }
    best = kInfinity;
  }
  const auto first = static_cast<int>(std::find(squares, square, least_square) - squares);
  evaluate({first / num_b, first % num_b});
  square = squares;
  for (int i = 0; i < num_a; ++i) {
    for (int j = 0; j < num_b; ++j, ++square) {
      const Bounded pair = {std::sqrt(*square), {i, j}};
      if (!(pair.ids == answer.ids) && !isLeftOut(pair)) *end++ = pair;
    }
  }
  for (bool nearer = true; end != pairs;) {
    const Eigen::Vector3d across =
        (answer.nearest.point_b - answer.nearest.point_a).template cast<double>();
    const double length = std::sqrt(detail::dot<double>(across, across));
    if (nearer && isLength(length)) {
      for (Bounded* pair = pairs; pair != end; ++pair) {
        const double slab = slabBetween(placed.a.triangle(pair->ids.a),
                                        placed.b.triangle(pair->ids.b), across / length);
        if (isLength(slab)) pair->bound = std::max(pair->bound, slab);
      }
      end = std::remove_if(pairs, end, isLeftOut);
      if (end == pairs) break;
    }
    Bounded* const next = std::min_element(
        pairs, end, [](const Bounded& x, const Bounded& y) { return x.bound < y.bound; });
    const engine::TrianglePairIds ids = next->ids;
    *next = *--end;
    nearer = evaluate(ids);
    if (nearer) end = std::remove_if(pairs, end, isLeftOut);
  }
  answer.least_other = leastOther();
  if (query.near_enough > 0 && answer.found() && best <= query.near_enough) {
    answer.end = engine::SearchEnd::kNear;
  }
  return answer;
}

template <typename S>
std::optional<engine::PairAnswer<S>> touchingOfFew(const MeshPair<S>& frame,
                                                   const engine::PairQuery& query,
                                                   SearchCounts& counts) {
  if (!areFew(frame.a, frame.b)) return std::nullopt;
  // Without planes that tell most pairs apart, trees lead to some pair sooner.
  const bool by_planes = std::min(frame.a.num_tris, frame.b.num_tris) <= kFewPlanes;
  if (query.any_touching && !by_planes) return std::nullopt;
  if (frame.rootBound(0) > 0) return noAnswer<S>();
  const PlacedPair<S> placed(frame);
  const engine::TrianglePairIds found = firstIntersecting(placed, counts);
  return found.a < 0 ? noAnswer<S>() : touchingAnswer(placed, query, found);
}

// All boxes are tested, then triangles by the distance of their boxes. What is left out is farther
// than NearestCandidates' allowance for rounding, which is far more than that of boxes.
template <typename S>
engine::PairAnswer<S> nearestOfFew(const MeshPair<S>& frame, const engine::PairQuery& query,
                                   SearchCounts& counts) {
  struct Bounded {
    double bound;
    engine::TrianglePairIds ids;
    bool operator<(const Bounded& o) const {
      return bound != o.bound ? bound < o.bound : ids < o.ids;
    }
  } bounded[kVeryFewPairs];
  const PlacedPair<S> placed(frame);
  Sides upper_b[kFewTriangles];
  const int num_a = placed.a.size(), num_b = placed.b.size();
  for (int j = 0; j < num_b; ++j) upper_b[j] = placed.b.box(j).upper();
  int n = 0, least = 0;
  for (int i = 0; i < num_a; ++i) {
    const Sides lower = placed.a.box(i).lower();
    for (int j = 0; j < num_b; ++j, ++n) {
      bounded[n] = {distance(lower, upper_b[j]), {i, j}};
      if (bounded[n].bound < bounded[least].bound) least = n;
    }
  }
  NearestCandidates<S> pairs(frame, query.far_enough);
  pairs.test(bounded[least].ids);
  bounded[least] = bounded[--n];
  const double most = pairs.cullDistance();
  const auto end = std::partition(bounded, bounded + n,
                                  [most](const Bounded& pair) { return pair.bound <= most; });
  std::sort(bounded, end);
  counts.leaf_pairs += num_a * num_b;
  ++counts.exact;
  for (const Bounded* pair = bounded; pair != end && !pairs.touching(); ++pair) {
    if (pair->bound > pairs.cullDistance()) break;
    pairs.test(pair->ids);
    ++counts.exact;
  }
  return pairs.answer();
}

KIOS_INSTANTIATE_FUNCTION(nearestPairByPair);
KIOS_INSTANTIATE_FUNCTION(touchingOfFew);
KIOS_INSTANTIATE_FUNCTION(nearestOfFew);

}  // namespace kios
