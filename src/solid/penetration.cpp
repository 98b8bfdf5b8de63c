// SPDX-FileCopyrightText: 2026 The fcl_kios authors
// SPDX-License-Identifier: BSD-3-Clause
#include "fcl_kios/solid/penetration.h"

#include <algorithm>
#include <cmath>
#include <optional>
#include <vector>

#include "query/pair_search.h"
#include "solid/ball_pairs.h"
#include "solid/common_center.h"
#include "solid/containment.h"
#include "solid/exit_search.h"
#include "solid/minkowski_hull.h"
#include "solid/solid_pair.h"
#include "triangle/predicates.h"
#include "volume/errors.h"
#include "volume/instantiate.h"
#include "volume/rounding.h"

namespace kios {
namespace {

using Vec = fcl::Vector3d;

void requireValid(const PenetrationOptions& options) {
  require(options.rel_gap >= 0, "PenetrationOptions::rel_gap", options.rel_gap, ">= 0");
  require(options.max_tests >= 0, "PenetrationOptions::max_tests", options.max_tests, ">= 0");
}

/// Returns the side of a plane on which a mesh lies: +1 or -1, touching or not, 0 if on both.
template <typename S, typename Corners>
int sideOf(const TriangleVertices<S>& plane, int num_triangles, const Corners& corners_of) {
  int side = 0;
  for (int t = 0; t < num_triangles; ++t) {
    const PairPredicates::Coordinates points = coordinatesOf(plane, corners_of(t));
    const PairPredicates exact(points);
    for (int i = 3; i < 6; ++i) {
      const int sign = exact.orient3d(0, 1, 2, i);
      if (sign == 0) continue;
      if (side == -sign) return 0;
      side = sign;
    }
  }
  return side;
}

/// Returns true if the plane of a triangle that meets another has all of a on one side and all of
/// b, as posed in a's frame, on the other, in exact arithmetic: the solids touch, but their
/// interiors are disjoint. Looked for only if a translation of `length`, which parts them, is one
/// of rounding.
template <typename S>
bool partedByFace(SolidPair<S>& pair, double length) {
  constexpr double kRoundings = 1 << 12;
  if (!(length <= kRoundings * pair.rounding())) return false;
  const MeshPair<S>& frame = pair.frame();
  std::vector<engine::TrianglePairIds> found;
  constexpr std::size_t kContacts = 16;
  if (!searchContacts(frame, kContacts, found, pair.counts())) return false;
  const auto of_a = [&](int t) { return frame.triangleA(t); };
  const auto of_b = [&](int t) { return frame.triangleB(t); };
  for (const auto& ids : found) {
    for (const TriangleVertices<S>& plane : {of_a(ids.a), of_b(ids.b)}) {
      const int side = sideOf(plane, frame.a.num_tris, of_a);
      if (side != 0 && sideOf(plane, frame.b.num_tris, of_b) == -side) return true;
    }
  }
  return false;
}

template <typename S>
class PenetrationQuery {
 public:
  PenetrationQuery(SolidPair<S>& pair, const PenetrationOptions& options)
      : pair_(pair), options_(options) {}

  Penetration run() {
    const MeshPair<S>& frame = pair_.frame();
    const Differences<S> differences(pair_);
    if (pair_.stateA().convexity(frame.a).convex && pair_.stateB().convexity(frame.b).convex) {
      constexpr int kPoints = 128;
      constexpr double kShare = 0.9;
      const HullDepth hull =
          hullDepth(differences, pair_.size(), kShare * options_.rel_gap, kPoints);
      lower_ = lowerOfHulls(hull.lower);
      exit_ = leaveHulls(differences, hull.normal.isZero(0)
                                          ? pair_.exitDirections()
                                          : std::vector<Vec>{pair_.R_WA() * hull.normal});
    } else {
      search(differences);
    }
    if (!closed()) raiseLower(true);
    Penetration result;
    if (partedByFace(pair_, exit_.length)) return result;
    result.upper = exit_.length;
    result.lower = std::min(lower_, exit_.length);
    result.translation = exit_.translation;
    result.point = exit_.on_a;
    return result;
  }

 private:
  /// Leaves by the one of the first few directions along which b leaves a's hull soonest.
  Exit leaveHulls(const Differences<S>& differences, const std::vector<Vec>& directions) {
    constexpr std::size_t kFew = 3;
    Vec best = Vec::UnitX();
    double least = kInfinity;
    for (std::size_t i = 0; i < std::min(kFew, directions.size()); ++i) {
      const Vec n = (pair_.R_WA().transpose() * directions[i]).normalized();
      const double height = differences.height(n);
      if (!(height < least)) continue;
      least = height;
      best = n;
    }
    return goAlong(pair_, pair_.R_WA() * best, least, pair_.size());
  }

  /// Serves solids that are not both convex. Those that overlap by little may leave as hulls do, or
  /// nearby; others leave where their inner balls part.
  void search(const Differences<S>& differences) {
    const std::vector<Vec> directions = pair_.exitDirections();
    const BallPairs balls(pair_);
    common_ = balls.common();
    const long long last_test = static_cast<long long>(pair_.tests()) + options_.max_tests;
    const bool deep = balls.meet(Vec::Zero());
    if (!deep) {
      exit_ = leaveHulls(differences, directions);
      raiseLower(false);
      if (closed()) return;
      exit_ = leaveNearby(pair_, exit_, directions, balls, last_test);
      raiseLower(false);
      if (closed()) return;
    }
    std::vector<Vec> in_a;
    constexpr std::size_t kFew = 3;
    for (std::size_t i = 0; i < std::min(kFew, directions.size()); ++i) {
      in_a.push_back(pair_.R_WA().transpose() * directions[i]);
    }
    const std::vector<BallPairs::Way> ways = balls.ways(in_a);
    if (deep) exit_ = leaveRoots(pair_, pair_.R_WA() * ways.front().direction);
    exit_ = leaveAnywhere(pair_, exit_, directions, ways, balls, last_test);
  }

  /// By balls: at the exit's ends, or `fully` by a search between them.
  void raiseLower(bool fully) {
    lower_ = std::max(lower_,
                      inWorld(depthOfBalls(pair_, exit_.on_a, exit_.translation,
                                           exit_.length / (1 + options_.rel_gap), fully, common_)));
  }

  bool closed() const { return exit_.length <= (1 + options_.rel_gap) * lower_; }

  // The vertices of both hulls lie within `moved` of points of the solids, whose hulls are in the
  // solids: see Convexity. So does each difference of two vertices.
  double lowerOfHulls(double lower) const {
    const MeshPair<S>& frame = pair_.frame();
    return inWorld(lower - pair_.stateA().convexity(frame.a).moved -
                   1.01 * pair_.stateB().convexity(frame.b).moved - pair_.rounding());
  }

  /// A translation in the world has R_WA^T of it in a's frame, longer by the stretch at most.
  double inWorld(double lower) const {
    const double stretch = detail::boundsOf(pair_.frame().X_AB).stretch;
    return std::max(0.0, lower / (1 + 2.1 * stretch + 0x1p-48));
  }

  SolidPair<S>& pair_;
  const PenetrationOptions& options_;
  Exit exit_;
  double lower_ = 0;
  std::optional<Vec> common_;  ///< a point in an inner ball of each, in a's frame
};

}  // namespace

template <typename S>
Penetration penetration(const Model<S>& solid1, const fcl::Transform3<S>& X_W1,
                        const Model<S>& solid2, const fcl::Transform3<S>& X_W2,
                        const PenetrationOptions& options) {
  requireValid(options);
  SearchCounts unused;
  SearchCounts& counts = options.counts ? *options.counts : unused;
  SolidPair<S> pair(solid1, X_W1, solid2, X_W2, counts);
  const MeshPair<S>& frame = pair.frame();
  if (frame.rootBound(0) > 0) return {};
  if (!surfacesMeet(frame, counts) && !containedPoint(frame, counts)) return {};
  return PenetrationQuery<S>(pair, options).run();
}

KIOS_INSTANTIATE_FUNCTION(penetration);

}  // namespace kios
