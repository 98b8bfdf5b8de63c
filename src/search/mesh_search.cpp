// SPDX-FileCopyrightText: 2026 The fcl_kios authors
// SPDX-License-Identifier: BSD-3-Clause
#include "search/mesh_search.h"

#include <algorithm>
#include <limits>
#include <utility>

#include "search/feature_distance.h"
#include "search/pairs_apart.h"
#include "volume/error_bounds.h"
#include "volume/instantiate.h"
#include "volume/rounding.h"

namespace kios::engine {
namespace {

float upToFloat(double v) { return v < 0x1p127 ? roundUpFloat(v) : kInfinityFloat; }

float downToFloat(double v) {
  if (v < 0) return -1;
  return v < 0x1p127 ? roundDown<float>(v) : 0x1p127F;
}

using error_bounds::featureError;

template <typename S>
bool exists(const TrianglePairIds& ids, const PreparedPair<S>& pair) {
  return ids.a >= 0 && static_cast<std::size_t>(ids.a) < pair.a.mesh.num_triangles && ids.b >= 0 &&
         static_cast<std::size_t>(ids.b) < pair.b.mesh.num_triangles;
}

TrianglePairIds idsOf(const Candidate& c) {
  return {static_cast<int>(c.a.triangle()), static_cast<int>(c.b.triangle())};
}

/// The plane of the face that was asked for last: a large one is near many vertices of a mesh.
class LastPlane {
 public:
  template <class Corner>
  const FacePlane& of(FeatureId face, const Corner& corner) {
    if (face.packed != face_) {
      face_ = face.packed;
      plane_ = FacePlane({corner(0), corner(1), corner(2)});
    }
    return plane_;
  }

 private:
  std::uint32_t face_ = ~0U;  ///< none
  FacePlane plane_;
};

template <typename S>
class NearestEvaluator final : public RefineCallback {
 public:
  /// Extents of edges are at most four times the scale.
  NearestEvaluator(const Corners<S>& corners, double scale, const PairQuery& query)
      : corners_(corners),
        query_(query),
        by_faces_(query.hasBudget()),
        least_shared_(featureError<S>(4 * scale)) {
    cull_distance = candidate_limit = upToFloat(query.far_enough);
  }

  [[gnu::hot]] bool evaluate(const Candidate& c) override {
    if (c.kind == PairKind::kEdgeFace || c.kind == PairKind::kFaceEdge) {
      const TrianglePairIds ids = idsOf(c);
      if (!apart_.intersect(corners_, ids)) return false;
      least_ = 0;
      take(0, ids);
      return true;
    }
    if (c.kind == PairKind::kFaces) return evaluateFaces(idsOf(c));
    const FeatureDistance found = distanceOf(c);
    const TrianglePairIds ids = idsOf(c);
    double distance = found.distance;
    // As near as rounding can tell, or so small that squares vanish: do their triangles meet?
    const bool vanishing = found.extent < kLeastExtent;
    if (distance <= featureError<S>(found.extent) || vanishing) {
      if (apart_.intersect(corners_, ids)) {
        distance = 0;
      } else {
        if (vanishing) distance = double{corners_.distanceOf(ids).distance};
        distance = std::max(distance, std::numeric_limits<double>::denorm_min());
      }
    }
    least_ = std::min(least_, distance);
    if (by_faces_) return distance < best_ && evaluateFaces(ids);
    if (++num_evaluated_ == next_look_ && nothingIsNearer()) return true;
    if (ids_.a < 0) {  // what was asked for may be the exact answer: certified() decides
      if (distance < best_ + featureError<S>(found.extent)) take(distance, ids);
    } else if (distance < best_ || (distance == best_ && ids < ids_)) {
      take(distance, ids);
    }
    return distance <= query_.near_enough && endsWith(ids);
  }

  void addUpperBound(float upper_bound) override {
    if (!(upper_bound < candidate_limit)) return;
    candidate_limit = upper_bound;
    cull_distance = std::min(
        cull_distance, keeps_pairs ? upToFloat(query_.cullDistance(upper_bound)) : upper_bound);
  }

  /// Triangles to begin with, their distance known. True to end the search.
  bool start(const TrianglePairIds& ids, double distance) {
    least_ = distance;
    take(distance, ids);
    return distance <= query_.near_enough && endsWith(ids);
  }

  TrianglePairIds ids() const { return ids_; }
  double least() const { return least_; }  ///< of all that was evaluated
  bool endedNear() const { return ended_near_; }
  TriangleDistance<S> certified() const {
    return faces_ == ids_ ? of_faces_ : corners_.distanceOf(ids_);
  }

  bool keeps_pairs =
      false;  ///< the search keeps the pairs of its upper bounds, so that errors apply

 private:
  /// The fourth power of a shorter extent, times what parts of it matter, would not be a normal
  /// number: see feature_distance.cpp.
  static constexpr double kLeastExtent = 0x1p-220;

  FeatureDistance distanceOf(const Candidate& c) {
    if (c.kind == PairKind::kEdgeEdge) {
      const Eigen::Vector3d p0 = corners_.ofA(c.a), p1 = corners_.ofA(c.a, 1);
      const Eigen::Vector3d q0 = corners_.ofB(c.b), q1 = corners_.ofB(c.b, 1);
      if (ends_.distance > least_shared_ && nearestAt(ends_, p0, p1, q0, q1))
        return {ends_.distance, ends_.distance};
      return edgeDistance(p0, p1, q0, q1, ends_);
    }
    if (c.kind == PairKind::kVertexFace) {
      const auto corner = [&](std::uint32_t k) { return corners_.ofB(c.b, k); };
      return plane_of_b_.of(c.b, corner).distance(corners_.ofA(c.a));
    }
    const auto corner = [&](std::uint32_t k) { return corners_.ofA(c.a, k); };
    return plane_of_a_.of(c.a, corner).distance(corners_.ofB(c.b));
  }

  /// Triangles as a whole: they may be nearer than the features that named them.
  bool evaluateFaces(const TrianglePairIds& ids) {
    faces_ = ids;
    of_faces_ = corners_.distanceOf(ids);
    const double distance = double{of_faces_.distance};
    least_ = std::min(least_, distance);
    if (distance < best_) take(distance, ids);
    return distance <= query_.near_enough && endsWith(ids);
  }

  /// Called when features were found near enough. Evaluates their triangles, by the distance that
  /// the answer states, and returns true if those are near enough to end the search.
  bool endsWith(const TrianglePairIds& ids) {
    if (!(faces_ == ids)) of_faces_ = corners_.distanceOf(faces_ = ids);
    if (!(double{of_faces_.distance} <= query_.near_enough)) return false;
    ids_ = ids;
    ended_near_ = true;
    return true;
  }

  void take(double distance, const TrianglePairIds& ids) {
    ids_ = ids;
    lowerTo(distance);
  }

  /// Ends the search of exact answers where many pairs are as near, as between walls that are
  /// parallel: true if a slab across the nearest points parts all of both meshes by the distance,
  /// but for a part of what that may be off by. Looked for each time so many pairs were evaluated
  /// as take longer than all vertices, so that it never takes more than they did.
  bool nothingIsNearer() {
    next_look_ *= 2;
    if (keeps_pairs || !(best_ > 0) || ids_.a < 0) return false;
    const TriangleDistance<S> nearest = corners_.distanceOf(ids_);
    const Eigen::Vector3d origin = nearest.point_a.template cast<double>();
    const Eigen::Vector3d n = nearest.point_b.template cast<double>() - origin;
    const double distance = double{nearest.distance};
    return n.norm() > 0 &&
           corners_.gapAlong(n, origin) >= (1 - 24 * error_bounds::kUlp<S>)*distance;
  }

  /// Called when a pair at this distance was found, or when no farther one is asked for.
  void lowerTo(double distance) {
    best_ = distance;
    candidate_limit = std::min(candidate_limit, upToFloat(distance));
    cull_distance = std::min(cull_distance, upToFloat(query_.cullDistance(distance)));
  }

  const Corners<S> corners_;
  const PairQuery& query_;
  const bool
      by_faces_;  ///< triangles are evaluated at once, so that no step makes the answer worse
  double best_ = kInfinity;  ///< of ids_
  double least_ = kInfinity;
  TrianglePairIds ids_, faces_;  ///< the nearest; those evaluated as faces
  TriangleDistance<S> of_faces_;
  bool ended_near_ = false;
  std::size_t num_evaluated_ = 0;
  std::size_t next_look_ = 1024 + corners_.numTriangles();  ///< at nothingIsNearer()
  NearestEnds ends_;
  PairsApart apart_;
  LastPlane plane_of_a_, plane_of_b_;
  const double least_shared_;  ///< nearer edges need their own extent; see evaluate()
};

/// Evaluates whole triangles; 0 is the only distance that matters.
class TouchingEvaluator final : public RefineCallback {
 public:
  explicit TouchingEvaluator(const VisitPair& visit) : visit_(visit) {
    cull_distance = candidate_limit = 0;
  }

  bool evaluate(const Candidate& c) override { return visit_(idsOf(c)); }
  void addUpperBound(float /*upper_bound*/) override {}

 private:
  const VisitPair& visit_;
};

/// Visits the pairs that `kernel` evaluates.
template <typename S>
void visitBy(void (*kernel)(const Search&), const PreparedPair<S>& pair, const VisitPair& visit,
             SearchCounts& counts) {
  TouchingEvaluator evaluator(visit);
  kernel({pair.a.tree, pair.b.tree, pair.pose, pair.frames, evaluator, counts, pair.audit});
}

}  // namespace

template <typename S>
[[gnu::hot]] PairAnswer<S> nearestTriangles(const PreparedPair<S>& pair, const PairQuery& query,
                                            SearchCounts& counts) {
  NearestEvaluator<S> evaluator(Corners<S>(pair), double{pair.frames.scale}, query);
  Bracket bracket;
  bracket.near_enough = downToFloat(query.near_enough);
  bracket.max_expansions = query.max_expansions;
  const bool exact = query.usesExactSearch() && !query.endsEarly();
  evaluator.keeps_pairs = !exact;
  bool has_bound = false, done = false;
  if (exists(query.start, pair)) {
    const double distance = double{Corners<S>(pair).distanceOf(query.start).distance};
    const bool near = query.near_enough > 0 && distance <= query.near_enough;
    if (!query.isExact() || query.hasBudget() || near) {
      done = evaluator.start(query.start, distance);
    } else if (distance > 0) {
      evaluator.addUpperBound(upToFloat(distance + featureError<S>(4 * double{pair.frames.scale})));
      has_bound = true;
    }
  }
  Search search = {pair.a.tree, pair.b.tree, pair.pose,  pair.frames,
                   evaluator,   counts,      pair.audit, &bracket};
  if (!done) (exact ? kernels().distance : kernels().bracket)(search);
  PairAnswer<S> result;
  result.ids = evaluator.ids();
  if (query.any_touching && evaluator.least() == 0) {  // no points are asked for
    result.nearest.point_a = result.nearest.point_b = fcl::Vector3<S>::Zero();
  } else if (result.ids.a >= 0) {
    result.nearest = evaluator.certified();
  }
  if (has_bound && result.ids.a >= 0 &&
      result.nearest.distance == 0) {  // any pair that intersects: which must not depend
    PairQuery cold = query;            // on where it began
    cold.start = {};
    return nearestTriangles(pair, cold, counts);
  }
  result.least_evaluated = evaluator.least();
  result.least_other = std::max(0.0F, exact ? evaluator.cull_distance : bracket.proven);
  if (evaluator.endedNear()) {
    result.end = SearchEnd::kNear;
  } else if (bracket.out_of_budget) {
    result.end = SearchEnd::kBudget;
  }
  return result;
}

template <typename S>
void visitTouching(const PreparedPair<S>& pair, const VisitPair& visit, SearchCounts& counts) {
  visitBy(kernels().contacts, pair, visit, counts);
}

template <typename S>
[[gnu::hot]] std::vector<TrianglePairIds> intersectingTriangles(const PreparedPair<S>& pair,
                                                                std::size_t limit,
                                                                SearchCounts& counts) {
  std::vector<TrianglePairIds> found;
  const Corners<S> corners(pair);
  if (limit == 1) {  // features name triangles many times
    PairsApart apart;
    visitBy(
        kernels().contact, pair,
        [&](const TrianglePairIds& ids) {
          if (apart.intersect(corners, ids)) found.push_back(ids);
          return !found.empty();
        },
        counts);
    return found;
  }
  visitTouching(
      pair,
      [&](const TrianglePairIds& ids) {
        if (corners.intersect(ids)) found.push_back(ids);
        return found.size() >= limit;
      },
      counts);
  std::sort(found.begin(), found.end());
  return found;
}

KIOS_INSTANTIATE_FUNCTION(nearestTriangles);
KIOS_INSTANTIATE_FUNCTION(visitTouching);
KIOS_INSTANTIATE_FUNCTION(intersectingTriangles);

}  // namespace kios::engine
