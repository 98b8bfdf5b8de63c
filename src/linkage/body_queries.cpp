// SPDX-FileCopyrightText: 2026 The fcl_kios authors
// SPDX-License-Identifier: BSD-3-Clause
#include "linkage/body_queries.h"

#include <algorithm>
#include <cmath>

#include "fcl_kios/contact.h"
#include "linkage/link_tree.h"
#include "linkage/tuning.h"
#include "model/prepared.h"
#include "query/pair_search.h"
#include "volume/errors.h"
#include "volume/rounding.h"
#include "volume/unit_vector.h"

namespace kios::articulated {
namespace {

// This is the error allowed to a query of the distance. Halving an interval costs as much as
// closing a bracket.
constexpr double kRelErr = 1;

/// A ball's centre in the frame of a body, whose distance from the body's shape bounds that of the
/// ball's content.
double ballBound(const BodyData& shape, const fcl::Transform3d& X_WS, const Eigen::Vector3d& center,
                 double radius) {
  const Eigen::Vector3d p = X_WS.linear().transpose() * (center - X_WS.translation());
  return shape::pointBound(shape.own->solid, p) - radius;
}

}  // namespace

bool isServed(const BodyData& a, const BodyData& b) {
  if (a.kind == BodyKind::kMesh || b.kind == BodyKind::kMesh) return true;
  const bool shapes = a.kind == BodyKind::kShape && b.kind == BodyKind::kShape;
  return shapes && (a.bounded || b.bounded);
}

void BodyQueries::requireServed(int a, int b) const {
  const BodyData &first = body(a), &second = body(b);
  if (isServed(first, second)) return;
  if (!first.bounded && !second.bounded) {
    refuse("half-spaces and planes are not checked against each other; ignore the pair.");
  }
  refusePair("a linkage's query", *first.own->geometry, *second.own->geometry);
}

double BodyQueries::rootBound(const Pair& pair, const Configuration& at, double enough) const {
  const int a = pair.a, b = pair.b;
  const BodyData &first = body(a), &second = body(b);
  const double pad = path_.pad(a, b);
  if (first.model && second.model) {
    // The volumes decide, as a slab is tried next: MeshPair::rootBound() takes longer, and with it
    // short free motions amid obstacles took 1.1 times as long (motions/arm_cell/valid/0.05).
    const RelativePose<double> X_AB(at.pose(a), at.pose(b),
                                    path_.rotationSquare(a) + path_.rotationSquare(b));
    return separation(first.model->getBV(0).bv, second.model->getBV(0).bv, X_AB, enough + pad) -
           pad;
  }
  double bound = -kInfinity;
  if (first.kind == BodyKind::kShape && second.bounded) {
    bound = ballBound(first, at.pose(a), at.center(b), second.content.radius);
  }
  if (second.kind == BodyKind::kShape && first.bounded) {
    bound = std::max(bound, ballBound(second, at.pose(b), at.center(a), first.content.radius));
  }
  return bound - pad;
}

// Frank-Wolfe steps towards the shortest difference of both hulls, as the tables bound them: v is a
// difference, and the hulls' support points along it give the slab, and the segment to search next.
double BodyQueries::slab(Pair& pair, const Configuration& at, double enough) const {
  if (!body(pair.a).bounded || !body(pair.b).bounded) return -kInfinity;
  Eigen::Vector3d v = pair.direction, n = v;
  if (v.isZero(0)) v = at.center(pair.b) - at.center(pair.a);
  const double pad = path_.pad(pair.a, pair.b);
  double best = -kInfinity;
  for (int step = 0; step < tuning::kSlabSteps; ++step) {
    const double length = v.norm();
    if (!(length > 0x1p-500)) break;
    n = v / length;
    Eigen::Vector3d on_a, on_b;
    const double gap = -at.support(pair.b, -n, on_b) - at.support(pair.a, n, on_a);
    if (gap > best) {
      best = gap;
      pair.direction = n;
    }
    const Eigen::Vector3d w = on_b - on_a;
    if (gap - pad > enough || (step > 0 && gap >= tuning::kClose * length)) break;
    if (step == 0) {
      v = w;
      continue;
    }
    const Eigen::Vector3d d = w - v;
    const double square = d.squaredNorm();
    if (!(square > 0)) break;
    v += std::clamp(-v.dot(d) / square, 0.0, 1.0) * d;
  }
  return best - pad;
}

Nearness BodyQueries::ask(Pair& pair, const Configuration& at, double enough) const {
  if (!body(pair.a).model && !body(pair.b).model) return askShapes(pair, at);
  Measured near = measure(pair, at, enough, kRelErr, min_separation_);
  if (near.lower > min_separation_ || !(min_separation_ > 0)) return {near.lower, near.contact};
  // A bracket that holds the separation may not stay open: there it is as fcl::distance() finds it.
  if (near.upper > min_separation_) near = measure(pair, at, enough, 0);
  bool contact = near.upper <= min_separation_;
  if (!contact && near.lower <= min_separation_) {
    fcl::DistanceResultd result;
    contact =
        meshAndOther(pair, at).distanceSurfaces(fcl::DistanceRequestd(), result) <= min_separation_;
  }
  return {near.lower, contact};
}

Measured BodyQueries::measure(Pair& pair, const Configuration& at, double far, double rel_err,
                              double near_enough) const {
  ++counts_.narrow_queries;
  const int a = pair.a, b = pair.b;
  const double pad = path_.pad(a, b), length = path_.length(a) + path_.length(b);
  Measured near;
  if (body(a).model && body(b).model) {
    engine::PairQuery query;
    query.rel_err = rel_err;
    query.near_enough = near_enough;
    query.far_enough = (far + pad) * (1 + 0x1p-40);
    const DistanceBracketResultd answer = bracketDistance(meshPair(pair, at), query);
    count(answer.counts);
    near.lower = answer.lower_bound - pad;
    near.contact = !(answer.distance > 0);
    if (answer.triangle_a >= 0 && answer.distance < query.far_enough) {
      near.upper = answer.upper_bound + pad;
      near.point_a = at.pose(a) * answer.point_a;
      near.point_b = at.pose(a) * answer.point_b;
    }
  } else if (body(a).model || body(b).model) {
    const MeshAndOther<double> bodies = meshAndOther(pair, at);
    const double error = pad + kernelError(shapeOf(body(a).model ? b : a), length);
    fcl::DistanceRequestd request;
    fcl::DistanceResultd result;
    request.enable_nearest_points = true;
    request.rel_err = rel_err;
    result.min_distance =
        std::min((far + error) * (1 + rel_err) * (1 + 0x1p-30), result.min_distance);
    SearchCounts counts;
    const double asked = result.min_distance,
                 distance = bodies.distanceSurfaces(request, result, &counts);
    count(counts);
    near.lower = distance / (1 + rel_err) * (1 - 0x1p-40) - error;
    near.contact = !(distance > error) && bodies.touch();
    if (distance < asked) {
      near.upper = std::max(0.0, distance) + error;
      const int first = result.o1 == body(a).own->geometry.get() ? 0 : 1;
      near.point_a = result.nearest_points[first];
      near.point_b = result.nearest_points[1 - first];
    }
  } else {
    near.lower = shapeGap(body(a), at.pose(a), body(b), at.pose(b)) - pad;
    near.contact = !(near.lower > 0) && shapesMeet(body(a), at.pose(a), body(b), at.pose(b), 0);
    nearPoints(body(a), at.pose(a), body(b), at.pose(b), near.point_a, near.point_b);
    near.upper = (near.point_b - near.point_a).norm() + pad;
  }
  if (near.upper < kInfinity) pair.direction = unitVector(near.point_b - near.point_a);
  return near;
}

bool BodyQueries::areSolids(const Pair& pair) const {
  const BodyData &a = body(pair.a), &b = body(pair.b);
  if (!a.model) return b.model && kios::areSolids<double>(*b.model, *a.own->geometry, nullptr);
  return kios::areSolids<double>(*a.model, *b.own->geometry, b.model);
}

bool BodyQueries::touching(const Pair& pair, const Configuration& at) const {
  const bool quick =
      body(pair.a).kind != BodyKind::kOctree && body(pair.b).kind != BodyKind::kOctree;
  return quick && !(min_separation_ > 0) && inContact(pair, at);
}

bool BodyQueries::inContact(const Pair& pair, const Configuration& at) const {
  const BodyData &a = body(pair.a), &b = body(pair.b);
  ++counts_.narrow_queries;
  if (!a.model && !b.model) {
    return shapesMeet(a, at.pose(pair.a), b, at.pose(pair.b), 0) &&
           !(gapOfShapes(pair.a, pair.b, at) > 0);
  }
  if (!a.model || !b.model || areSolids(pair)) return meshAndOther(pair, at).touch();
  SearchCounts counts;
  const bool touch = !searchContacts(meshPair(pair, at), 1, counts).empty();
  count(counts);
  return touch;
}

void BodyQueries::count(const SearchCounts& counts) const {
  counts_.expansions += counts.expansions;
  cost_ += counts.volume_tests + tuning::kTestsOfLeaves * counts.leaf_kernels;
}

MeshPair BodyQueries::meshPair(const Pair& pair, const Configuration& at) const {
  return {meshOf(*body(pair.a).model), at.pose(pair.a), meshOf(*body(pair.b).model),
          at.pose(pair.b), path_.rotationSquare(pair.a) + path_.rotationSquare(pair.b)};
}

MeshAndOther<double> BodyQueries::meshAndOther(const Pair& pair, const Configuration& at) const {
  return kios::meshAndOther(*body(pair.a).own->geometry, at.pose(pair.a),
                            *body(pair.b).own->geometry, at.pose(pair.b));
}

double BodyQueries::gapOfShapes(int a, int b, const Configuration& at,
                                Eigen::Vector3d* direction) const {
  return shapeGap(body(a), at.pose(a), body(b), at.pose(b), direction) - path_.pad(a, b);
}

// What a slab proves counts: FCL's GJK sees contacts at gaps of up to 1e-6.
Nearness BodyQueries::askShapes(Pair& pair, const Configuration& at) const {
  ++counts_.narrow_queries;
  const int a = pair.a, b = pair.b;
  Eigen::Vector3d direction = Eigen::Vector3d::Zero();
  const double apart = gapOfShapes(a, b, at, &direction);
  const bool slab = apart > 0 && !direction.isZero(0);
  if (slab) pair.direction = direction;
  if (apart > min_separation_) return {apart, false, slab};
  return {apart, shapesMeet(body(a), at.pose(a), body(b), at.pose(b), min_separation_), slab};
}

}  // namespace kios::articulated
