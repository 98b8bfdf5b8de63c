// SPDX-FileCopyrightText: 2026 The fcl_kios authors
// SPDX-License-Identifier: BSD-3-Clause
#include "linkage/body_queries.h"

#include <algorithm>
#include <cmath>

#include "fcl_kios/query/mesh_queries.h"
#include "linkage/link_tree.h"
#include "linkage/tuning.h"
#include "model/prepared.h"
#include "query/pair_search.h"
#include "volume/errors.h"
#include "volume/rounding.h"

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
  return shape::pointBound(shape.solid, p) - radius;
}

Eigen::Vector3d unitOrZero(const Eigen::Vector3d& v) {
  const double length = v.norm();
  return length > 0x1p-500 ? Eigen::Vector3d(v / length) : Eigen::Vector3d::Zero();
}

/// What fcl::distance() gives. Searches that begin or end otherwise may find another of two pairs
/// of triangles that are equally near, and so differ by a rounding.
double distanceOfQuery(const Modeld& a, const fcl::Transform3d& X_WA, const Modeld& b,
                       const fcl::Transform3d& X_WB) {
  fcl::DistanceResultd result;
  return distanceMeshes(a, X_WA, b, X_WB, fcl::DistanceRequestd(), result);
}

/// The error of the distance of a mesh from a shape or a cell, L the extent (docs/shapes.md).
double kernelError(const BodyData& other, double length) {
  const shape::Solid& solid = other.solid;
  if (other.kind == BodyKind::kShape && solid.kind == shape::Kind::kConvex &&
      solid.num_faces == 0) {
    return 0x1p-28 * length;
  }
  double error = 0x1p-41 * length;
  if (other.kind == BodyKind::kShape && solid.kind == shape::Kind::kEllipsoid) {
    double least = kInfinity;
    for (int i = 0; i < 3; ++i) {
      if (!shape::isFlat(solid.half, i)) least = std::min(least, solid.half[i]);
    }
    if (least < length) error *= length / least;
  }
  return error;
}

}  // namespace

void BodyQueries::requireServed(int a, int b) const {
  const BodyData &first = body(a), &second = body(b);
  if (first.kind == BodyKind::kMesh || second.kind == BodyKind::kMesh) return;
  if (first.kind == BodyKind::kOctree || second.kind == BodyKind::kOctree) {
    refusePair("checkMotion", *first.geometry, *second.geometry);
  }
  if (!first.bounded && !second.bounded) {
    refuse("half-spaces and planes are not checked against each other; allow the pair.");
  }
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
  ++counts_.narrow_queries;
  const bool mesh_a = body(pair.a).model, mesh_b = body(pair.b).model;
  if (mesh_a && mesh_b) return askMeshes(pair, at, enough);
  if (mesh_a) return askMeshAndOther(pair, pair.a, pair.b, at, enough);
  if (mesh_b) return askMeshAndOther(pair, pair.b, pair.a, at, enough);
  return askShapes(pair, at);
}

bool BodyQueries::areSolids(const Pair& pair) const {
  const BodyData &a = body(pair.a), &b = body(pair.b);
  if (!a.model) return b.model && kios::areSolids<double>(*b.model, *a.geometry, nullptr);
  return kios::areSolids<double>(*a.model, *b.geometry, b.model);
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
  counts_.expansions += counts.expansions;
  return touch;
}

MeshPair BodyQueries::meshPair(const Pair& pair, const Configuration& at) const {
  return {meshOf(*body(pair.a).model), at.pose(pair.a), meshOf(*body(pair.b).model),
          at.pose(pair.b), path_.rotationSquare(pair.a) + path_.rotationSquare(pair.b)};
}

MeshAndOther<double> BodyQueries::meshAndOther(const Pair& pair, const Configuration& at) const {
  const int mesh = body(pair.a).model ? pair.a : pair.b, other = mesh == pair.a ? pair.b : pair.a;
  return {*body(mesh).model, at.pose(mesh), *body(other).geometry, at.pose(other),
          body(other).model};
}

Nearness BodyQueries::askMeshes(Pair& pair, const Configuration& at, double enough) const {
  const int a = pair.a, b = pair.b;
  const double pad = path_.pad(a, b);
  const MeshPair frame = meshPair(pair, at);
  engine::PairQuery query;
  query.rel_err = kRelErr;
  query.near_enough = min_separation_;
  query.far_enough = (enough + pad) * (1 + 0x1p-40);
  const auto search = [&] {
    const auto answer = bracketDistance(frame, query);
    counts_.expansions += answer.counts.expansions;
    query.start = {answer.triangle_a, answer.triangle_b};
    return answer;
  };
  auto answer = search();
  // A bracket that holds the separation asked for may not stay open.
  if (answer.distance > min_separation_ && answer.lower_bound <= min_separation_ + pad &&
      min_separation_ > 0) {
    query.rel_err = 0;
    answer = search();
  }
  if (answer.triangle_a >= 0) {
    pair.direction = unitOrZero(at.pose(a).linear() * (answer.point_b - answer.point_a));
  }
  bool contact = answer.distance <= min_separation_;
  if (contact && min_separation_ > 0 && answer.distance > min_separation_ - pad) {
    contact =
        distanceOfQuery(*body(a).model, at.pose(a), *body(b).model, at.pose(b)) <= min_separation_;
  }
  return {answer.lower_bound - pad, contact};
}

Nearness BodyQueries::askMeshAndOther(Pair& pair, int mesh, int other, const Configuration& at,
                                      double enough) const {
  const MeshAndOther<double> bodies = meshAndOther(pair, at);
  const double error =
      path_.pad(mesh, other) + kernelError(body(other), path_.length(mesh) + path_.length(other));
  fcl::DistanceRequestd request;
  fcl::DistanceResultd result;
  request.rel_err = 0.5;
  request.enable_nearest_points = true;
  result.min_distance = (enough + error) * (1 + request.rel_err) * (1 + 0x1p-30);
  const double asked = result.min_distance;
  double distance = bodies.distanceSurfaces(request, result);
  if (distance > 0 && distance < asked) {
    const Eigen::Vector3d d = result.nearest_points[1] - result.nearest_points[0];
    pair.direction = unitOrZero(result.o1 == body(pair.a).geometry.get() ? d : -d);
  }
  const double apart = distance / (1 + request.rel_err) * (1 - 0x1p-40) - error;
  if (distance > min_separation_ && apart > min_separation_) return {apart, false};
  if (distance >= asked) return {apart, false};
  if (min_separation_ > 0) {
    if (distance > min_separation_ - error) {  // as fcl::distance() finds it
      request.rel_err = 0;
      result = fcl::DistanceResultd();
      distance = bodies.distanceSurfaces(request, result);
    }
    return {distance - error, distance <= min_separation_};
  }
  if (distance > error) return {apart, false};
  return {apart, bodies.touch()};
}

double BodyQueries::gapOfShapes(int a, int b, const Configuration& at,
                                Eigen::Vector3d* direction) const {
  return shapeGap(body(a), at.pose(a), body(b), at.pose(b), direction) - path_.pad(a, b);
}

// What a slab proves counts: FCL's GJK sees contacts at gaps of up to 1e-6.
Nearness BodyQueries::askShapes(Pair& pair, const Configuration& at) const {
  const int a = pair.a, b = pair.b;
  Eigen::Vector3d direction = Eigen::Vector3d::Zero();
  const double apart = gapOfShapes(a, b, at, &direction);
  const bool slab = apart > 0 && !direction.isZero(0);
  if (slab) pair.direction = direction;
  if (apart > min_separation_) return {apart, false, slab};
  return {apart, shapesMeet(body(a), at.pose(a), body(b), at.pose(b), min_separation_), slab};
}

}  // namespace kios::articulated
