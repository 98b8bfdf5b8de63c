// SPDX-FileCopyrightText: 2026 The fcl_kios authors
// SPDX-License-Identifier: BSD-3-Clause
#include "fcl_kios/solid/penetration.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <optional>
#include <utility>
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
template <typename Corners>
int sideOf(const TriangleVerticesd& plane, int num_triangles, const Corners& corners_of) {
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
/// interiors are disjoint. What meets tells, but for rounding, which planes may.
template <typename S>
bool partedByFace(SolidPair<S>& pair) {
  const MeshPair& frame = pair.frame();
  const auto& contacts = pair.overlap().contacts;
  const double rounding = 16 * pair.rounding();
  const auto mayPart = [&](const Vec& n, const Vec& p) {
    return std::all_of(contacts.begin(), contacts.end(), [&](const auto& contact) {
      for (int k = 0; k < 3; ++k) {
        if (n.dot(contact.a[k] - p) > rounding || n.dot(contact.b[k] - p) < -rounding) return false;
      }
      return true;
    });
  };
  const auto of_a = [&](int t) { return frame.triangleA(t); };
  const auto of_b = [&](int t) { return frame.triangleB(t); };
  for (const auto& contact : contacts) {
    for (const auto& face : {contact.a, contact.b}) {
      const Vec n = normalOf(face);
      if (!mayPart(n, face[0]) && !mayPart(-n, face[0])) continue;
      const int side = sideOf(face, pair.a().num_tris, of_a);
      if (side != 0 && sideOf(face, pair.b().num_tris, of_b) == -side) return true;
    }
  }
  return false;
}

/// Returns an order of pairs that doesn't depend on which is named first: by size, by root volumes,
/// by poses, by coordinates.
template <typename S>
bool comesFirst(const Model<S>& a, const fcl::Transform3<S>& X_WA, const Model<S>& b,
                const fcl::Transform3<S>& X_WB) {
  int first = a.num_tris != b.num_tris ? a.num_tris - b.num_tris : a.num_vertices - b.num_vertices;
  const auto compare = [&](const auto* p, const auto* q, std::ptrdiff_t n) {
    if (first != 0) return;
    const auto [x, y] = std::mismatch(p, p + n, q);
    if (x != p + n) first = *x < *y ? 1 : -1;
  };
  compare(a.getBV(0).bv.center0.data(), b.getBV(0).bv.center0.data(), 3);
  compare(X_WA.data(), X_WB.data(), 16);
  if (&a != &b) compare(a.vertices->data(), b.vertices->data(), 3 * a.num_vertices);
  return first >= 0;
}

template <typename S>
class PenetrationQuery {
 public:
  PenetrationQuery(SolidPair<S>& pair, const PenetrationOptions& options)
      : pair_(pair), options_(options) {}

  Penetration run() {
    const Differences<S> differences(pair_);
    std::vector<Vec> directions;
    if (pair_.stateA().convexity(pair_.a()).convex && pair_.stateB().convexity(pair_.b()).convex) {
      constexpr int kPoints = 128;
      constexpr double kShare = 0.9;
      const HullDepth hull =
          hullDepth(differences, pair_.size(), kShare * options_.rel_gap, kPoints);
      lower_ = lowerOfHulls(hull.lower);
      if (!hull.normal.isZero(0)) directions.push_back(hull.normal);
    }
    std::optional<BallPairs> balls;
    if (directions.empty()) {
      directions = meanDirections(pair_);
      balls.emplace(pair_);
      if (balls->depth() > 0) directions.resize(1);  // they hardly leave as hulls do
    }
    exit_ = leaveHulls(pair_, differences, directions);
    if (!closed()) {
      if (!balls) balls.emplace(pair_);
      if (balls->depth() == 0) {
        raiseLower(false);
        if (!(lower_ > 0) && partedByFace(pair_)) return {};
      }
      common_ = balls->common();
      if (!closed()) search(*balls);
    }
    Penetration result;
    result.upper = exit_.length;
    result.lower = std::min(lower_, exit_.length);
    result.translation = pair_.movesA() ? Vec(-exit_.translation) : exit_.translation;
    result.point = pair_.movesA() ? Vec(exit_.after.on_b - exit_.translation) : exit_.after.on_a;
    return result;
  }

 private:
  /// Planes of triangles come first, unless the hulls' exit is so much longer than they that the
  /// balls probably close the bracket: then they follow if these don't.
  void search(const BallPairs& balls) {
    double edge = 0;
    for (const auto& contact : pair_.overlap().contacts) {
      for (const auto& t : {contact.a, contact.b}) {
        edge = std::max({edge, (t[1] - t[0]).norm(), (t[2] - t[1]).norm()});
      }
    }
    constexpr double kLong = 2.5, kDeep = 0.5;
    constexpr std::size_t kMany = 256, kFew = 64;
    const bool fine = exit_.length > kLong * edge;
    const auto deep = [&] { return std::max(balls.depth(), lower_) > kDeep * edge; };
    const long long first = pair_.tests(), last = first + options_.max_tests;
    if (fine || deep() || !leaveByPlanes(pair_, kMany, (first + last) / 2, exit_)) {
      leaveByBalls(pair_, balls, last, exit_);
    }
    raiseLower(true);
    if (!fine || deep() || closed()) return;
    leaveByPlanes(pair_, kFew, last, exit_);
    raiseLower(true);
  }

  /// By balls: at the exit's ends, or `fully` by a search between them.
  void raiseLower(bool fully) {
    lower_ = std::max(lower_,
                      inWorld(depthOfBalls(pair_, exit_.after.on_a, exit_.translation,
                                           exit_.length / (1 + options_.rel_gap), fully, common_)));
  }

  bool closed() const { return exit_.length <= (1 + options_.rel_gap) * lower_; }

  // The vertices of both hulls lie within `moved` of points of the solids, whose hulls are in the
  // solids: see Convexity. So does each difference of two vertices.
  double lowerOfHulls(double lower) const {
    return inWorld(lower - pair_.stateA().convexity(pair_.a()).moved -
                   1.01 * pair_.stateB().convexity(pair_.b()).moved - pair_.rounding());
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
  const bool as_given = comesFirst(solid1, X_W1, solid2, X_W2);
  SolidPair<S> pair = as_given ? SolidPair<S>(solid1, X_W1, solid2, X_W2, counts, false)
                               : SolidPair<S>(solid2, X_W2, solid1, X_W1, counts, true);
  const MeshPair& frame = pair.frame();
  if (frame.rootBound(0) > 0) return {};
  const bool surfaces_meet = !searchContacts(frame, 1, counts).empty();
  if (!surfaces_meet && !containedPoint(pair.a(), pair.b(), frame, counts)) return {};
  return PenetrationQuery<S>(pair, options).run();
}

KIOS_INSTANTIATE_FUNCTION(penetration);

}  // namespace kios
