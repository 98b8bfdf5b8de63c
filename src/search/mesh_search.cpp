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
      if (query_.apart || !apart_.intersect(corners_, ids)) return false;
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
      if (!query_.apart && apart_.intersect(corners_, ids)) {
        distance = 0;
      } else {
        if (vanishing) distance = double{corners_.distanceOf(ids).distance};
        distance = std::max(distance, std::numeric_limits<double>::denorm_min());
      }
    }
    least_ = std::min(least_, distance);
    if (by_faces_) return distance < best_ && evaluateFaces(ids);
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
  NearestEnds ends_;
  PairsApart apart_;
  LastPlane plane_of_a_, plane_of_b_;
  const double least_shared_;  ///< nearer edges need their own extent; see evaluate()
};

/// The features of some triangles of a mesh, each by its first triangle, as in Ownership: by
/// triangle, the corners at which it owns an edge, and those at which it owns a vertex, as bits.
struct OwnFeatures {
  unsigned int edges = 7, vertices = 7;
};

template <typename S>
std::vector<OwnFeatures> ownFeatures(const MeshView<S>& mesh, const std::vector<int>& triangles) {
  std::vector<OwnFeatures> own(triangles.size());
  const auto corner = [&](std::size_t i, int k) -> const fcl::Vector3<S>& {
    return mesh.corner(static_cast<std::size_t>(triangles[i]), static_cast<std::size_t>(k % 3));
  };
  for (std::size_t i = 0; i < triangles.size(); ++i) {
    for (std::size_t j = 0; j <= i; ++j) {  // the triangles ascend
      for (int k = 0; k < 3; ++k) {
        for (int l = 0; l < (i == j ? k : 3); ++l) {
          const auto &v = corner(i, k), &next_v = corner(i, k + 1);
          const auto &w = corner(j, l), &next_w = corner(j, l + 1);
          if (v == w) own[i].vertices &= ~(1U << k);
          if ((v == w && next_v == next_w) || (v == next_w && next_v == w)) {
            own[i].edges &= ~(1U << k);
          }
        }
      }
    }
  }
  return own;
}

/// The triangles of one side of some pairs, ascending.
std::vector<int> trianglesOf(const std::vector<TrianglePairIds>& pairs,
                             int TrianglePairIds::*side) {
  std::vector<int> triangles;
  triangles.reserve(pairs.size());
  for (const TrianglePairIds& ids : pairs) triangles.push_back(ids.*side);
  std::sort(triangles.begin(), triangles.end());
  triangles.erase(std::unique(triangles.begin(), triangles.end()), triangles.end());
  return triangles;
}

template <typename S>
class IntersectionEvaluator final : public RefineCallback {
 public:
  IntersectionEvaluator(const PreparedPair<S>& pair, std::size_t limit)
      : corners_(pair), limit_(limit) {
    cull_distance = candidate_limit = 0;
  }

  [[gnu::hot]] bool evaluate(const Candidate& c) override {
    const TrianglePairIds ids = idsOf(c);
    const bool once = limit_ > 1;  // every pair is evaluated once
    if (once ? corners_.intersect(ids) : apart_.intersect(corners_, ids)) found.push_back(ids);
    return found.size() >= limit_;
  }

  void addUpperBound(float /*upper_bound*/) override {}

  std::vector<TrianglePairIds> found;

 private:
  const Corners<S> corners_;
  const std::size_t limit_;
  PairsApart apart_;
};

}  // namespace

// A feature near enough to matter belongs to a pair near enough to be given, and so does the same
// feature of its first triangle: ownership among the triangles given is that of the mesh.
template <typename S>
TrianglePairIds nearestOfThese(const std::vector<TrianglePairIds>& pairs, const MeshView<S>& a,
                               const MeshView<S>& b, const RelativePose<S>& X_AB) {
  if (pairs.size() == 1) return pairs[0];
  const auto triangles_a = trianglesOf(pairs, &TrianglePairIds::a),
             triangles_b = trianglesOf(pairs, &TrianglePairIds::b);
  const auto own_a = ownFeatures(a, triangles_a), own_b = ownFeatures(b, triangles_b);
  const auto ownOf = [](const std::vector<int>& triangles, const std::vector<OwnFeatures>& own,
                        int id) {
    const auto at = std::lower_bound(triangles.begin(), triangles.end(), id) - triangles.begin();
    return own[static_cast<std::size_t>(at)];
  };
  const PairQuery query;
  NearestEvaluator<S> evaluator(Corners<S>(a, b, X_AB), kInfinity, query);
  for (const TrianglePairIds& ids : pairs) {
    const OwnFeatures of_a = ownOf(triangles_a, own_a, ids.a),
                      of_b = ownOf(triangles_b, own_b, ids.b);
    const std::uint32_t face_a = static_cast<std::uint32_t>(ids.a) << 2,
                        face_b = static_cast<std::uint32_t>(ids.b) << 2;
    for (std::uint32_t i = 0; i < 3; ++i) {
      for (std::uint32_t j = 0; j < 3; ++j) {
        if ((of_a.edges >> i & of_b.edges >> j & 1U) == 0) continue;
        evaluator.evaluate({PairKind::kEdgeEdge, {face_a | i}, {face_b | j}});
      }
      if ((of_a.vertices >> i & 1U) != 0) {
        evaluator.evaluate({PairKind::kVertexFace, {face_a | i}, {face_b}});
      }
      if ((of_b.vertices >> i & 1U) != 0) {
        evaluator.evaluate({PairKind::kFaceVertex, {face_a}, {face_b | i}});
      }
    }
  }
  return evaluator.ids();
}

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
[[gnu::hot]] std::vector<TrianglePairIds> intersectingTriangles(const PreparedPair<S>& pair,
                                                                std::size_t limit,
                                                                SearchCounts& counts) {
  IntersectionEvaluator<S> evaluator(pair, limit);
  const Search search = {pair.a.tree, pair.b.tree, pair.pose, pair.frames,
                         evaluator,   counts,      pair.audit};
  if (limit == 1) {
    kernels().contact(search);
  } else {
    kernels().contacts(search);
  }
  if (limit > 1) std::sort(evaluator.found.begin(), evaluator.found.end());
  return std::move(evaluator.found);
}

KIOS_INSTANTIATE_FUNCTION(nearestOfThese);
KIOS_INSTANTIATE_FUNCTION(nearestTriangles);
KIOS_INSTANTIATE_FUNCTION(intersectingTriangles);

}  // namespace kios::engine
