// SPDX-FileCopyrightText: 2026 The fcl_kios authors
// SPDX-License-Identifier: BSD-3-Clause
#include "query/pair_search.h"

#include <algorithm>
#include <cmath>

#include "model/walk.h"
#include "query/posed_tree.h"
#include "search/mesh_search.h"
#include "volume/balls.h"
#include "volume/error_bounds.h"
#include "volume/rounding.h"

namespace kios {
namespace {

using engine::PairAnswer;
using engine::PairQuery;
using engine::SearchEnd;
using engine::TrianglePairIds;
using PairIds = std::vector<TrianglePairIds>;

/// A search of two trees in double, by the nodes' central spheres, for models that floats can't
/// tell of together: either is of no ordinary size, or they are far apart for their sizes. Depth
/// first, the nearer of two children before the other. With a budget it is best first, so that more
/// of it never proves less.
class DoubleSearch {
 public:
  DoubleSearch(const MeshPair& frame, SearchCounts& counts)
      : frame_(frame),
        a_{frame.a.tree(), Eigen::Matrix3d::Identity(), Eigen::Vector3d::Zero(), 1},
        b_{frame.b.tree(), frame.X_AB.R(), frame.X_AB.T(), 1},
        counts_(counts) {
    const engine::Tree &a = frame.a.tree(), &b = frame.b.tree();
    ++counts.tree_searches;
    const Eigen::Map<const Eigen::Vector3d> origin_a(a.origin), origin_b(b.origin);
    const detail::PoseBounds& bounds = detail::boundsOf(frame.X_AB);
    const Eigen::Vector3d t = b_.R * origin_b + frame.X_AB.T() - origin_a;
    const double reach_a = std::ldexp(double{a.reach}, a.exponent),
                 reach_b = std::ldexp(double{b.reach}, b.exponent);
    // In units of a power of two no square over- or underflows, but of what doesn't matter.
    exponent_ = exponentOf(std::max({reach_a, reach_b, t.cwiseAbs().maxCoeff()}));
    const auto toUnits = [this](double length) { return std::ldexp(length, -exponent_); };
    a_.unit = std::ldexp(1.0, a.exponent - exponent_);
    b_.unit = std::ldexp(1.0, b.exponent - exponent_);
    for (int c = 0; c < 3; ++c) b_.t[c] = toUnits(t[c]);
    const double reach = toUnits(reach_a) + toUnits(reach_b);
    const double points = error_bounds::volumeError<double>(
        origin_b.lpNorm<1>() + 2 * reach_b, bounds.T_norm1 + origin_a.lpNorm<1>(), 2 * reach_a, 0);
    // This bounds the error of points as stored and as posed, and a dozen roundings here.
    error_ = error_bounds::laneError(reach) + toUnits(points) +
             (2 * bounds.stretch + engine::kDouble) * (reach + b_.t.lpNorm<1>());
  }

  PairAnswer nearest(const PairQuery& query) {
    query_ = &query;
    cull_distance_ = query.far_enough;
    // Which pair an exact answer names must not depend on the start.
    const bool starts = !query.isExact() || query.hasBudget();
    if (starts && frame_.exist(query.start) && evaluate(query.start, -kInfinity)) return result_;
    long long left = query.max_expansions;
    const auto skip = [this](const NodePair& at) {
      if (!(at.bound >= cull_distance_)) return false;
      left_out_ = std::min(left_out_, at.bound);
      return true;
    };
    const auto visit = [&](const NodePair& at, const auto& add) {
      const auto test = [&](const TrianglePairIds& ids) { return evaluate(ids, at.bound); };
      const bool leaves = areLeaves(at);
      if (!leaves && left-- == 0) {
        result_.end = SearchEnd::kBudget;
      } else if (!leaves) {
        expand(at, add);
        return false;
      } else if (!testLeaves(at, test)) {
        return false;
      }
      left_out_ = std::min(left_out_, at.bound);  // of what the end leaves untested
      return true;
    };
    const std::vector<NodePair> rest =
        walkNearestFirst(bounded(0, 0, -kInfinity), skip, visit, query.hasBudget());
    for (const NodePair& pair : rest) left_out_ = std::min(left_out_, pair.bound);
    result_.least_other = std::max(0.0, left_out_);
    return result_;
  }

  void visitTouching(const engine::VisitPair& test) {
    const auto skip = [](const NodePair& at) { return at.bound > 0; };
    const auto visit = [&](const NodePair& at, const auto& add) {
      if (areLeaves(at)) return testLeaves(at, test);
      expand(at, add);
      return false;
    };
    walkNearestFirst(bounded(0, 0, -kInfinity), skip, visit);
  }

  /// Up to `limit` pairs of triangles that intersect, by ids.
  PairIds contacts(std::size_t limit) {
    PairIds found;
    visitTouching([&](const TrianglePairIds& ids) {
      ++counts_.exact;
      if (frame_.intersect(ids)) found.push_back(ids);
      return found.size() >= limit;
    });
    std::sort(found.begin(), found.end());
    return found;
  }

 private:
  struct NodePair {
    double bound;
    std::uint32_t a, b;
  };

  NodePair bounded(std::uint32_t a, std::uint32_t b, double parent) const {
    ++counts_.volume_tests;
    const double apart =
        (b_.center(b) - a_.center(a)).norm() - (a_.radius(a) + b_.radius(b)) - error_;
    return {std::max(std::ldexp(apart, exponent_), parent), a, b};
  }

  bool areLeaves(const NodePair& at) const { return a_.isLeaf(at.a) && b_.isLeaf(at.b); }

  /// Puts the children of the larger node in its place.
  template <typename Add>
  void expand(const NodePair& at, const Add& add) {
    ++counts_.expansions;
    if (b_.isLeaf(at.b) || (!a_.isLeaf(at.a) && a_.radius(at.a) > b_.radius(at.b))) {
      a_.forChildren(at.a, [&](std::uint32_t child) { add(bounded(child, at.b, at.bound)); });
    } else {
      b_.forChildren(at.b, [&](std::uint32_t child) { add(bounded(at.a, child, at.bound)); });
    }
  }

  /// All pairs of triangles of two leaves, until test() returns true, which is returned.
  template <typename Test>
  bool testLeaves(const NodePair& at, const Test& test) {
    ++counts_.leaf_pairs;
    return a_.anyTriangle(at.a, [&](std::uint32_t a) {
      return b_.anyTriangle(at.b, [&](std::uint32_t b) {
        return test(TrianglePairIds{static_cast<int>(a), static_cast<int>(b)});
      });
    });
  }

  /// Triangles in volumes that are at least `bound` apart. True to end the search.
  bool evaluate(const TrianglePairIds& ids, double bound) {
    ++counts_.exact;
    const TriangleDistanced found = frame_.distanceOf(ids);
    const double distance = found.distance, best = result_.least_evaluated;
    const double proven = std::max(bound, distance - frame_.distanceError(distance));
    result_.proven_evaluated =
        best < kInfinity ? std::min(result_.proven_evaluated, proven) : proven;
    if (distance > best || (distance == best && result_.ids < ids)) return false;
    result_.ids = ids;
    result_.nearest = found;
    result_.least_evaluated = distance;
    // For an exact answer, every pair is evaluated that rounding alone may have made farther:
    // bounds of volumes include the frame's, and no pair beyond them is computed to be as near.
    cull_distance_ =
        std::min(cull_distance_, query_->isExact() ? distance + frame_.kernelError(distance)
                                                   : query_->cullDistance(distance));
    if (!(distance <= query_->near_enough)) return false;
    result_.end = SearchEnd::kNear;
    return true;
  }

  const MeshPair& frame_;
  PosedTree a_, b_;  ///< about a's origin
  int exponent_;     ///< of the unit
  double error_;     ///< of a bound, in units
  SearchCounts& counts_;
  const PairQuery* query_ = nullptr;
  double cull_distance_ = kInfinity;
  double left_out_ = kInfinity;  ///< least bound of the pairs left out
  PairAnswer result_;
};

/// Sets what was proven, with all rounding paid for.
void setBounds(const MeshPair& frame, const PairAnswer& found, DistanceBracketResultd& answer) {
  double lower = found.least_other;
  if (found.least_evaluated < kInfinity) {
    const double error = frame.distanceError(found.least_evaluated);
    lower = std::min(lower, std::max({0.0, found.least_evaluated - error, found.proven_evaluated}));
  }
  if (found.found()) {
    answer.distance = found.nearest.distance;
    answer.upper_bound = answer.distance + frame.distanceError(answer.distance);
    answer.triangle_a = found.ids.a;
    answer.triangle_b = found.ids.b;
    answer.point_a = found.nearest.point_a;
    answer.point_b = found.nearest.point_b;
    lower = std::min(lower, answer.distance);
  }
  answer.lower_bound = std::max(lower, found.roots);
}

}  // namespace

[[gnu::hot]] PairAnswer searchNearest(const MeshPair& frame, const PairQuery& query,
                                      SearchCounts& counts) {
  double roots = 0;
  if (query.far_enough < kInfinity || query.hasBudget()) {
    roots = std::max(0.0, frame.rootBound(std::min(query.far_enough, 0x1p1000)));
  }
  if (roots > 0 && roots >= query.far_enough) {
    PairAnswer far;
    far.nearest.point_a = far.nearest.point_b = Pointd::Zero();
    far.least_other = far.roots = roots;
    return far;
  }
  PairAnswer answer = frame.floats_serve ? engine::nearestTriangles(frame, query, counts)
                                         : DoubleSearch(frame, counts).nearest(query);
  answer.roots = roots;
  return answer;
}

[[gnu::hot]] PairIds searchContacts(const MeshPair& frame, std::size_t limit,
                                    SearchCounts& counts) {
  if (frame.rootBound(0) > 0) return {};
  if (!frame.floats_serve) return DoubleSearch(frame, counts).contacts(limit);
  return engine::intersectingTriangles(frame, limit, counts);
}

void visitTouching(const MeshPair& frame, const engine::VisitPair& visit, SearchCounts& counts) {
  if (!frame.floats_serve) return DoubleSearch(frame, counts).visitTouching(visit);
  engine::visitTouching(frame, visit, counts);
}

DistanceBracketResultd bracketDistance(const MeshPair& frame, const PairQuery& query) {
  DistanceBracketResultd answer;
  if (query.far_enough <= 0) {
    answer.stop = DistanceStop::kFar;
    return answer;
  }
  const PairAnswer found = searchNearest(frame, query, answer.counts);
  setBounds(frame, found, answer);
  if (answer.distance == 0) {
    answer.stop = DistanceStop::kTolerance;
  } else if (found.end == SearchEnd::kNear) {
    answer.stop = DistanceStop::kNear;
  } else if (answer.lower_bound >= query.far_enough) {
    answer.stop = DistanceStop::kFar;
  } else if (found.end == SearchEnd::kBudget) {
    answer.stop = DistanceStop::kBudget;
  } else if (answer.distance > query.far_enough) {
    // Within rounding of far_enough neither this is proven nor all that is nearer than the answer
    // was looked at: a search without it decides. With a budget the bracket stands as it is.
    if (query.hasBudget()) {
      answer.stop = DistanceStop::kBudget;
    } else {
      PairQuery unlimited = query;
      unlimited.far_enough = kInfinity;
      const SearchCounts before = answer.counts;
      answer = bracketDistance(frame, unlimited);
      answer.counts += before;
    }
  }
  return answer;
}

}  // namespace kios
