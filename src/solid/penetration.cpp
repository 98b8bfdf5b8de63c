// SPDX-FileCopyrightText: 2026 The fcl_kios authors
// SPDX-License-Identifier: BSD-3-Clause
#include "fcl_kios/solids.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <optional>
#include <utility>
#include <vector>

#include "fcl_kios/triangle.h"
#include "query/nearest_on_mesh.h"
#include "query/pair_search.h"
#include "solid/containment.h"
#include "solid/exit_search.h"
#include "solid/inner_balls.h"
#include "solid/minkowski_hull.h"
#include "solid/solid_pair.h"
#include "solid/tuning.h"
#include "triangle/predicates.h"
#include "volume/errors.h"
#include "volume/instantiate.h"
#include "volume/rounding.h"

namespace kios {
namespace {

using Vec = fcl::Vector3d;

void requireValid(const PenetrationRequest& options) {
  require(options.rel_gap >= 0, "PenetrationRequest::rel_gap", options.rel_gap, ">= 0");
  require(options.max_tests >= 0, "PenetrationRequest::max_tests", options.max_tests, ">= 0");
}

/// The balls about a point, in a's frame.
struct Balls {
  bool in_a = false, in_b = false;
  double depth = 0;  ///< proven
};

class CommonCenter {
 public:
  explicit CommonCenter(SolidPair& pair) : pair_(pair) {}

  // The place of c relative to b, and its distance, are those of y = R^T (c - T) in b's frame, but
  // for inverseError(): if b's surface is farther than that, both are on one side. R shrinks no
  // distance by more than the same share of it, which is within the error, too.
  Balls at(const Vec& c) {
    const RelativePose<double>& X_AB = pair_.frame().X_AB;
    Balls balls;
    const Vec y = toB(X_AB, c);
    balls.in_a = placeOf(c, pair_.a(), pair_.counts()).inside();
    balls.in_b = placeOf(y, pair_.b(), pair_.counts()).inside();
    if (!balls.in_a || !balls.in_b) return balls;
    const NearestOnMesh a = nearestOnMesh(pair_.a(), c, kInfinity);
    const NearestOnMesh b = nearestOnMesh(pair_.b(), y, kInfinity);
    on_a_.push_back(a.point);
    on_b_.push_back(X_AB * b.point);
    const double error =
        2 * inverseError(X_AB, c.lpNorm<1>() + 4 * pair_.size()) + 2 * pair_.rounding();
    if (!(b.lower > error) || !(a.lower > pair_.rounding())) return balls;
    balls.depth = a.lower - pair_.rounding() + b.lower - error;
    return balls;
  }

  /// Returns where the balls may be largest within `reach` of c, by the points of the surfaces that
  /// are known, and by how much at most.
  std::pair<Vec, double> highest(const Vec& c, double reach) const {
    const auto nearest = [](const std::vector<Vec>& points, const Vec& p, Vec& away) {
      away.setZero();
      double least = kInfinity;
      for (const Vec& q : points) {
        const double square = (p - q).squaredNorm();
        if (!(square < least)) continue;
        least = square;
        away = p - q;
      }
      least = std::sqrt(least);
      away /= least;
      return least;
    };
    Vec top = c, at = c, u = Vec::Zero(), v = Vec::Zero();
    double highest = 0, step = 0.5 * reach;
    for (int i = 0; i < tuning::kUphill; ++i) {
      const double depth = nearest(on_a_, at, u) + nearest(on_b_, at, v);
      if (depth > highest) {
        highest = depth;
        top = at;
      } else {
        step *= 0.7;
      }
      const Vec uphill = u + v;
      const double slope = uphill.norm();
      if (!(slope > 1e-3)) break;
      at += step / slope * uphill;
      const Vec way = at - c;
      if (way.norm() > reach) at = c + reach * way.normalized();
    }
    return {top, highest};
  }

 private:
  SolidPair& pair_;
  std::vector<Vec> on_a_, on_b_;  ///< points of the surfaces, in a's frame
};

/// Returns a lower bound of the length of any translation that parts the solids: if balls of radii
/// r and s about one point lie in a and in b, their interiors part only where |t| >= r + s. The
/// point is sought on the way by which b leaves, from `on_a` against `translation` (in the world):
/// at its ends, where solids touch that overlap by little. If `fully`, it is sought between them
/// and from `common` (in a's frame), and from there uphill, until the bound reaches `required` or
/// little more can be hoped for. 0 if no common point was found.
double depthOfBalls(SolidPair& pair, const Vec& on_a, const Vec& translation, double required,
                    bool fully, const std::optional<Vec>& common) {
  CommonCenter center(pair);
  const Vec from = pair.inA(on_a), way = -pair.vectorInA(translation);
  // Where a's surface is flat and b's isn't the balls are best at b's end, and at a's.
  if (!fully) {
    double depth = 0;
    for (const double end : {0.985, 0.015}) {
      if (depth < required) depth = std::max(depth, center.at(from + end * way).depth);
    }
    return depth;
  }
  Vec best = from;
  Balls balls;
  const auto tryPoint = [&](const Vec& c) {
    const Balls here = center.at(c);
    if (here.depth > balls.depth) {
      balls = here;
      best = c;
    }
    return here;
  };
  if (common) tryPoint(*common);
  // Near 0 the way is in a, near 1 in b; in between it is in both, or never.
  double low = 0, high = 1;
  for (int i = 0; i < tuning::kUphill && balls.depth < required; ++i) {
    const double share = 0.5 * (low + high);
    const Balls here = tryPoint(from + share * way);
    if (here.in_a == here.in_b) break;
    (here.in_a ? low : high) = share;
  }
  // If that isn't enough, from where the surfaces meet, a little way into both.
  const auto& contacts = pair.overlap().contacts;
  for (std::size_t i = 0; i < contacts.size(); i += 2) {
    const Vec seam = intersectionPoint(contacts[i].a, contacts[i].b);
    const Vec inwards = -normalOf(contacts[i].a) - normalOf(contacts[i].b);
    for (double step = 0.3 * translation.norm(); step > 0.01 * translation.norm(); step *= 0.3) {
      if (balls.depth >= required || tryPoint(seam + step * inwards).depth > 0) break;
    }
  }
  if (!(balls.depth > 0)) return 0;
  double reach = 0.8 * balls.depth;
  for (int i = 0; i < tuning::kUphill && balls.depth < required; ++i) {
    const auto [c, hope] = center.highest(best, reach);
    if (!(hope > balls.depth)) break;
    const double before = balls.depth;
    tryPoint(c);
    if (!(balls.depth > before)) reach *= 0.5;
    if (balls.depth > 2 * before) reach = 0.8 * balls.depth;  // it began much too small
  }
  return balls.depth;
}

/// Returns the side of a plane on which a mesh lies: +1 or -1, touching or not, 0 if on both.
template <typename Corners>
int sideOf(const TriangleVerticesd& plane, std::size_t num_triangles, const Corners& corners_of) {
  int side = 0;
  for (std::size_t t = 0; t < num_triangles; ++t) {
    const PairPredicates::Coordinates points =
        coordinatesOf(plane, corners_of(static_cast<int>(t)));
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
bool partedByFace(SolidPair& pair) {
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
      const int side = sideOf(face, pair.a().numTriangles(), of_a);
      if (side != 0 && sideOf(face, pair.b().numTriangles(), of_b) == -side) return true;
    }
  }
  return false;
}

class PenetrationQuery {
 public:
  PenetrationQuery(SolidPair& pair, const PenetrationRequest& options)
      : pair_(pair), options_(options), exits_(pair), exit_(exits_.best()) {}

  PenetrationResult run() {
    const Differences differences(pair_);
    std::vector<Vec> directions;
    if (pair_.convexityA().convex && pair_.convexityB().convex) {
      const HullDepth hull = hullDepth(differences, pair_.size(), options_.rel_gap,
                                       static_cast<int>(tuning::kCorners));
      lower_ = lowerOfHulls(hull.lower);
      if (!hull.normal.isZero(0)) directions.push_back(hull.normal);
    }
    std::optional<BallPairs> balls;
    if (directions.empty()) {
      directions = meanDirections(pair_);
      balls.emplace(pair_.ballsA(), pair_.ballsB(), pair_.frame().X_AB);
      if (balls->depth() > 0) directions.resize(1);  // they hardly leave as hulls do
    }
    exits_.leaveHulls(differences, directions);
    if (!closed()) {
      if (!balls) balls.emplace(pair_.ballsA(), pair_.ballsB(), pair_.frame().X_AB);
      if (balls->depth() == 0) {
        raiseLower(false);
        if (!(lower_ > 0) && partedByFace(pair_)) return {};
      }
      common_ = balls->common();
      if (!closed()) search(*balls);
    }
    PenetrationResult result;
    result.upper = exit_.length;
    result.lower = std::min(lower_, exit_.length);
    result.translation = pair_.swapped() ? Vec(-exit_.translation) : exit_.translation;
    result.point = pair_.swapped() ? Vec(exit_.after.on_b - exit_.translation) : exit_.after.on_a;
    return result;
  }

 private:
  /// By planes of triangles, unless balls are deep: there they find nothing shorter.
  void search(const BallPairs& balls) {
    double edge = 0;
    for (const auto& contact : pair_.overlap().contacts) {
      for (const auto& t : {contact.a, contact.b}) {
        edge = std::max({edge, (t[1] - t[0]).norm(), (t[2] - t[1]).norm()});
      }
    }
    const bool deep = std::max(balls.depth(), lower_) > tuning::kDeep * edge;
    const long long first = pair_.tests(), last = first + options_.max_tests;
    if (deep || !exits_.leaveByPlanes((first + last) / 2)) exits_.leaveByBalls(balls, last);
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
    return inWorld(lower - pair_.convexityA().moved - 1.01 * pair_.convexityB().moved -
                   pair_.rounding());
  }

  /// A translation in the world has R_WA^T of it in a's frame, longer by the stretch at most.
  double inWorld(double lower) const {
    const double stretch = detail::boundsOf(pair_.frame().X_AB).stretch;
    return std::max(0.0, lower / (1 + 2.1 * stretch + 0x1p-48));
  }

  SolidPair& pair_;
  const PenetrationRequest& options_;
  ExitSearch exits_;
  const Exit& exit_;
  double lower_ = 0;
  std::optional<Vec> common_;  ///< a point in an inner ball of each, in a's frame
};

}  // namespace

template <typename S>
PenetrationResult penetration(const Model<S>& solid1, const fcl::Transform3<S>& X_W1,
                              const Model<S>& solid2, const fcl::Transform3<S>& X_W2,
                              const PenetrationRequest& options) {
  requireValid(options);
  SearchCounts unused;
  SearchCounts& counts = options.counts ? *options.counts : unused;
  SolidPair pair =
      inOrder(meshOf(solid1), X_W1.template cast<double>(), meshOf(solid2),
              X_W2.template cast<double>(), squaredRotationErrors(X_W1, X_W2), counts, true);
  const MeshPair& frame = pair.frame();
  if (frame.rootBound(0) > 0) return {};
  const bool surfaces_meet = !searchContacts(frame, 1, counts).empty();
  if (!surfaces_meet && !containedPoint(frame, counts)) return {};
  return PenetrationQuery(pair, options).run();
}

KIOS_INSTANTIATE_FUNCTION(penetration);

}  // namespace kios
