// SPDX-FileCopyrightText: 2026 The fcl_kios authors
// SPDX-License-Identifier: BSD-3-Clause
#include "search/mesh_search.h"

#include <algorithm>
#include <array>
#include <limits>
#include <optional>
#include <utility>

#include "search/feature_distance.h"
#include "volume/error_bounds.h"
#include "volume/rounding.h"

namespace kios::engine {
namespace {

float upToFloat(double v) { return v < 0x1p127 ? roundUpFloat(v) : kInfinityFloat; }

float downToFloat(double v) {
  if (v < 0) return -1;
  return v < 0x1p127 ? roundDown<float>(v) : 0x1p127F;
}

using error_bounds::featureError;

TrianglePairIds idsOf(const Candidate& c) {
  return {static_cast<int>(c.a.triangle()), static_cast<int>(c.b.triangle())};
}

/// Extents of edges are at most four times the scale.
double largestExtent(const MeshPair& pair) { return 4 * pair.X_trees.scale; }

/// How far all of b lies beyond all of a along n, of any length, from `origin`; less than what
/// rounding may have made of it. A difference, three products and two sums: each height is off by
/// at most 6 u of the sum of its terms' absolute values.
double gapAlong(const MeshPair& pair, const Pointd& n, const Pointd& origin) {
  const auto least = [&](std::size_t num_triangles, double sign, const auto& triangleOf) {
    double height = kInfinity, terms = 0;
    for (int t = 0; t < static_cast<int>(num_triangles); ++t) {
      for (const Pointd& p : triangleOf(t)) {
        const Pointd v = n.cwiseProduct(p - origin);
        height = std::min(height, sign * (v[0] + v[1] + v[2]));
        terms = std::max(terms, v.lpNorm<1>());
      }
    }
    return height - 8 * kUlpDouble * terms;
  };
  const double of_b = least(pair.b.numTriangles(), 1, [&](int t) { return pair.triangleB(t); }),
               of_a = least(pair.a.numTriangles(), -1, [&](int t) { return pair.triangleA(t); });
  return (of_b + of_a) / n.norm() * (1 - 8 * kUlpDouble);
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

/// Remembers some triangles that don't intersect: those that nearly touch are named by many of
/// their features, and by edges that may cross faces.
class PairsApart {
 public:
  /// Asks the triangles, unless they are known.
  bool intersect(const MeshPair& pair, const TrianglePairIds& ids) {
    if (!known_) known_.emplace();
    const auto a = static_cast<std::uint32_t>(ids.a), b = static_cast<std::uint32_t>(ids.b);
    TrianglePairIds& known = (*known_)[(a * 0x9E3779B1U + b * 0x85EBCA6BU) >> (32 - kBits)];
    if (known == ids) return false;
    if (pair.intersect(ids)) return true;
    known = ids;
    return false;
  }

 private:
  static constexpr std::uint32_t kBits = 6, kNumber = 1U << kBits;
  std::optional<std::array<TrianglePairIds, kNumber>> known_;  // most searches need none
};

class NearestEvaluator final : public RefineCallback {
 public:
  NearestEvaluator(const MeshPair& pair, const PairQuery& query)
      : pair_(pair),
        query_(query),
        by_faces_(query.hasBudget()),
        least_shared_(featureError(largestExtent(pair))) {
    cull_distance = candidate_limit = upToFloat(query.far_enough);
  }

  [[gnu::hot]] bool evaluate(const Candidate& c) override {
    if (c.kind == PairKind::kEdgeFace || c.kind == PairKind::kFaceEdge) {
      const TrianglePairIds ids = idsOf(c);
      if (!apart_.intersect(pair_, ids)) return false;
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
    if (distance <= featureError(found.extent) || vanishing) {
      if (apart_.intersect(pair_, ids)) {
        distance = 0;
      } else {
        if (vanishing) distance = pair_.distanceOf(ids).distance;
        distance = std::max(distance, std::numeric_limits<double>::denorm_min());
      }
    }
    least_ = std::min(least_, distance);
    if (by_faces_) return distance < best_ && evaluateFaces(ids);
    if (++num_evaluated_ == next_look_ && nothingIsNearer()) return true;
    if (ids_.a < 0) {  // what was asked for may be the exact answer: certified() decides
      if (distance < best_ + featureError(found.extent)) take(distance, ids);
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
  TriangleDistanced certified() const {
    return faces_ == ids_ ? of_faces_ : pair_.distanceOf(ids_);
  }

  bool keeps_pairs =
      false;  ///< the search keeps the pairs of its upper bounds, so that errors apply

 private:
  /// The fourth power of a shorter extent, times what parts of it matter, would not be a normal
  /// number: see feature_distance.cpp.
  static constexpr double kLeastExtent = 0x1p-220;

  static std::size_t cornerOf(FeatureId id, std::uint32_t step) {
    const std::uint32_t k = id.corner() + step;
    return k < 3 ? k : k - 3;
  }
  Pointd ofA(FeatureId id, std::uint32_t step = 0) const {
    return pair_.a.corner(id.triangle(), cornerOf(id, step));
  }
  Pointd ofB(FeatureId id, std::uint32_t step = 0) const {
    return pair_.X_AB * pair_.b.corner(id.triangle(), cornerOf(id, step));
  }

  FeatureDistance distanceOf(const Candidate& c) {
    if (c.kind == PairKind::kEdgeEdge) {
      const Eigen::Vector3d p0 = ofA(c.a), p1 = ofA(c.a, 1);
      const Eigen::Vector3d q0 = ofB(c.b), q1 = ofB(c.b, 1);
      if (ends_.distance > least_shared_ && nearestAt(ends_, p0, p1, q0, q1))
        return {ends_.distance, ends_.distance};
      return edgeDistance(p0, p1, q0, q1, ends_);
    }
    if (c.kind == PairKind::kVertexFace) {
      const auto corner = [&](std::uint32_t k) { return ofB(c.b, k); };
      return faceDistance(plane_of_b_.of(c.b, corner), ofA(c.a));
    }
    const auto corner = [&](std::uint32_t k) { return ofA(c.a, k); };
    return faceDistance(plane_of_a_.of(c.a, corner), ofB(c.b));
  }

  /// Triangles as a whole: they may be nearer than the features that named them.
  bool evaluateFaces(const TrianglePairIds& ids) {
    faces_ = ids;
    of_faces_ = pair_.distanceOf(ids);
    const double distance = of_faces_.distance;
    least_ = std::min(least_, distance);
    if (distance < best_) take(distance, ids);
    return distance <= query_.near_enough && endsWith(ids);
  }

  /// Called when features were found near enough. Evaluates their triangles, by the distance that
  /// the answer states, and returns true if those are near enough to end the search.
  bool endsWith(const TrianglePairIds& ids) {
    if (!(faces_ == ids)) of_faces_ = pair_.distanceOf(faces_ = ids);
    if (!(of_faces_.distance <= query_.near_enough)) return false;
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
    const TriangleDistanced nearest = pair_.distanceOf(ids_);
    const Pointd n = nearest.point_b - nearest.point_a;
    return n.norm() > 0 &&
           gapAlong(pair_, n, nearest.point_a) >= (1 - 24 * kUlpDouble) * nearest.distance;
  }

  /// Called when a pair at this distance was found, or when no farther one is asked for.
  void lowerTo(double distance) {
    best_ = distance;
    candidate_limit = std::min(candidate_limit, upToFloat(distance));
    cull_distance = std::min(cull_distance, upToFloat(query_.cullDistance(distance)));
  }

  const MeshPair& pair_;
  const PairQuery& query_;
  const bool
      by_faces_;  ///< triangles are evaluated at once, so that no step makes the answer worse
  double best_ = kInfinity;  ///< of ids_
  double least_ = kInfinity;
  TrianglePairIds ids_, faces_;  ///< the nearest; those evaluated as faces
  TriangleDistanced of_faces_;
  bool ended_near_ = false;
  std::size_t num_evaluated_ = 0;
  std::size_t next_look_ =
      1024 + pair_.a.numTriangles() + pair_.b.numTriangles();  ///< at nothingIsNearer()
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

/// A search of a pair, which lasts as long as its frames.
struct PairSearch {
  PairSearch(const MeshPair& pair, RefineCallback& evaluator, SearchCounts& counts, Audit* audit)
      : search{pair.a.tree(), pair.b.tree(), pair.X_trees, frames, evaluator, counts, audit} {
    makeFloatFrame(pair.X_trees, frames);
  }
  FloatFrame frames;
  Search search;
};

}  // namespace

[[gnu::hot]] PairAnswer nearestTriangles(const MeshPair& pair, const PairQuery& query,
                                         SearchCounts& counts, Audit* audit) {
  NearestEvaluator evaluator(pair, query);
  Bracket bracket;
  bracket.near_enough = downToFloat(query.near_enough);
  bracket.max_expansions = query.max_expansions;
  const bool exact = query.isExact() && !query.endsEarly();
  evaluator.keeps_pairs = !exact;
  bool has_bound = false, done = false;
  if (pair.exist(query.start)) {
    const double distance = pair.distanceOf(query.start).distance;
    const bool near = query.near_enough > 0 && distance <= query.near_enough;
    if (!query.isExact() || query.hasBudget() || near) {
      done = evaluator.start(query.start, distance);
    } else if (distance > 0) {
      evaluator.addUpperBound(upToFloat(distance + featureError(largestExtent(pair))));
      has_bound = true;
    }
  }
  PairSearch of(pair, evaluator, counts, audit);
  of.search.bracket = &bracket;
  if (!done) (exact ? kernels().distance : kernels().bracket)(of.search);
  PairAnswer result;
  result.ids = evaluator.ids();
  if (query.any_touching && evaluator.least() == 0) {  // no points are asked for
    result.nearest.point_a = result.nearest.point_b = Pointd::Zero();
  } else if (result.ids.a >= 0) {
    result.nearest = evaluator.certified();
  }
  if (has_bound && result.ids.a >= 0 &&
      result.nearest.distance == 0) {  // any pair that intersects: which must not depend
    PairQuery cold = query;            // on where it began
    cold.start = {};
    return nearestTriangles(pair, cold, counts, audit);
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

void visitTouching(const MeshPair& pair, const VisitPair& visit, SearchCounts& counts,
                   Audit* audit) {
  TouchingEvaluator evaluator(visit);
  kernels().contacts(PairSearch(pair, evaluator, counts, audit).search);
}

[[gnu::hot]] std::vector<TrianglePairIds> intersectingTriangles(const MeshPair& pair,
                                                                std::size_t limit,
                                                                SearchCounts& counts,
                                                                Audit* audit) {
  std::vector<TrianglePairIds> found;
  if (limit == 1) {  // features name triangles many times
    PairsApart apart;
    const VisitPair visit = [&](const TrianglePairIds& ids) {
      if (apart.intersect(pair, ids)) found.push_back(ids);
      return !found.empty();
    };
    TouchingEvaluator evaluator(visit);
    kernels().contact(PairSearch(pair, evaluator, counts, audit).search);
    return found;
  }
  visitTouching(
      pair,
      [&](const TrianglePairIds& ids) {
        if (pair.intersect(ids)) found.push_back(ids);
        return found.size() >= limit;
      },
      counts, audit);
  std::sort(found.begin(), found.end());
  return found;
}

}  // namespace kios::engine
