// SPDX-FileCopyrightText: 2026 The fcl_kios authors
// SPDX-License-Identifier: BSD-3-Clause
#include "solid/mesh_and_other.h"

#include <algorithm>
#include <cmath>
#include <functional>
#include <limits>
#include <optional>
#include <vector>

#include "fcl_kios/detail/rigid.h"
#include "fcl_kios/solids.h"
#include "query/nearest_on_mesh.h"
#include "query/shape_search.h"
#include "shape/solid.h"
#include "solid/containment.h"
#include "volume/rounding.h"

namespace kios {
namespace {

using Vec = fcl::Vector3d;

constexpr int kNone = -1;

/// A point of a bounded shape: all but the convex one are centred at their origin.
Vec pointOf(const shape::Solid& shape) {
  return shape.kind == shape::Kind::kConvex ? shape.points[0] : Vec(Vec::Zero());
}

/// Proves the shape apart from the solid after a translation, which it may round: returns the
/// solid's point nearest to it then.
using ProveApart = std::function<std::optional<Vec>(Vec& translation)>;

/// Search for a short translation of a shape that is proven to part it from a solid that it
/// overlaps: away from the hull along a few directions, shortened by bisection.
class ShapeExit {
 public:
  ShapeExit(const Mesh& mesh, const fcl::Transform3d& X_WM, const shape::Solid& shape,
            const fcl::Transform3d& X_WS, const ProveApart& prove_apart)
      : mesh_(mesh), shape_(shape), X_WM_(X_WM), X_WS_(X_WS), prove_apart_(prove_apart) {}

  /// `epsilon` is that of the scalar in which translations are proven.
  PenetrationResult run(double epsilon) {
    Vec best = Vec::Zero();
    double length = kInfinity;
    const std::vector<Vec> directions = this->directions();
    for (const Vec& n : directions) {
      const double exit = exitAlong(n);
      if (!(exit < length)) continue;
      length = exit;
      best = n;
    }
    const Vec between = X_WM_.translation() - X_WS_.translation();
    double margin = epsilon * (16 * (mesh_.largest() + (shape_.bounded() ? shape_.reach() : 0)) +
                               16 * between.lpNorm<1>() + 4 * X_WS_.translation().lpNorm<1>());
    constexpr int kTries = 60;
    for (int i = 0; i < kTries && !accept((std::max(length, 0.0) + margin) * best); ++i) {
      margin *= 4;
    }
    if (!(exit_.upper > 0)) return exit_;
    for (const Vec& n : directions) {
      for (double share = 0.7; accept(share * exit_.upper * n); share = 0.5) {
      }
    }
    // Its own direction, to a percent.
    const Vec end = exit_.translation;
    for (double low = 0.3, high = 1; high - low > 0.01;) {
      const double middle = 0.5 * (low + high);
      (accept(middle * end) ? high : low) = middle;
    }
    return exit_;
  }

 private:
  /// The way by which the shape leaves the mesh's hull along n, in the world. A half-space or plane
  /// ends along its own normal alone, to the bit: it takes the place of what differs by rounding.
  double exitAlong(const Vec& n) const {
    Vec in_shape = X_WS_.linear().transpose() * -n;
    if (!shape_.bounded())
      in_shape = in_shape.dot(shape_.normal) > 0 ? shape_.normal : Vec(-shape_.normal);
    const Vec in_mesh = X_WM_.linear().transpose() * n;
    return in_mesh.dot(farthestVertex(mesh_, in_mesh)) + shape::extentAlong(shape_, in_shape) -
           n.dot(X_WS_.translation() - X_WM_.translation());
  }

  std::vector<Vec> directions() const {
    const fcl::Matrix3d &R_WM = X_WM_.linear(), &R_WS = X_WS_.linear();
    if (!shape_.bounded()) {
      const Vec n = (R_WS * shape_.normal).normalized();
      if (shape_.kind == shape::Kind::kHalfspace) return {-n};
      return {n, -n};
    }
    std::vector<Vec> directions;
    const auto add = [&](const Vec& v) {
      if (v.norm() > 0) directions.push_back(v.normalized());
    };
    const Vec center = R_WM.transpose() * (X_WS_ * pointOf(shape_) - X_WM_.translation());
    const Vec wall = R_WM * (nearestOnMesh(mesh_, center, kInfinity).point - center);
    add(wall);
    add(-wall);
    add(R_WM * (center - mesh_.center()));
    for (int c = 0; c < 3; ++c) {
      for (const double sign : {1.0, -1.0}) {
        add(sign * R_WM.col(c));
        add(sign * R_WS.col(c));
      }
    }
    return directions;
  }

  /// Keeps the translation if it is proven to part them and shorter.
  bool accept(Vec x) {
    if (exit_.upper > 0 && !(x.norm() < exit_.upper)) return false;
    const std::optional<Vec> point = prove_apart_(x);
    if (!point || (exit_.upper > 0 && !(x.norm() < exit_.upper))) return false;
    exit_ = {0, x.norm(), x, *point};
    return true;
  }

  const Mesh& mesh_;
  const shape::Solid& shape_;
  const fcl::Transform3d X_WM_, X_WS_;
  const ProveApart& prove_apart_;
  PenetrationResult exit_;
};

/// A point of a surface that lies in the other solid, in the world. The surfaces must not meet.
/// Half-spaces and planes are in no solid.
template <typename S>
std::optional<fcl::Vector3<S>> containedIn(const MeshAndOther<S>& o) {
  if (!o.other_mesh) {
    const shape::Solid shape = toSolid(o.other);
    if (!shape.bounded()) return std::nullopt;
    const fcl::Vector3<S> p = detail::transform<S>(o.X_WO, roundedTo<S>(pointOf(shape)));
    if (!contains<S>(o.mesh, o.X_WM, p)) return std::nullopt;
    return p;
  }
  const MeshPair frame(meshOf(o.mesh), o.X_WM, meshOf(*o.other_mesh), o.X_WO);
  SearchCounts unused;
  if (frame.rootBound(0) > 0) return std::nullopt;
  const auto point = containedPoint(frame, unused);
  if (!point) return std::nullopt;
  return toWorld<S>(o.X_WM, *point);
}

/// For a shape there is no lower bound.
template <typename S>
PenetrationResult wayOut(const MeshAndOther<S>& o) {
  if (o.other_mesh) return penetration(o.mesh, o.X_WM, *o.other_mesh, o.X_WO);
  const ProveApart prove_apart = [&o](Vec& x) -> std::optional<Vec> {
    fcl::Transform3<S> X_WS = o.X_WO;
    const fcl::Vector3<S> rounded = roundedTo<S>(x);
    X_WS.translation() += rounded;
    x = rounded.template cast<double>();
    const MeshAndOther<S> moved = {o.mesh, o.X_WM, o.other, X_WS, nullptr};
    fcl::DistanceResult<S> found;
    if (!(moved.distanceSurfaces(fcl::DistanceRequest<S>(true), found) > 0)) return std::nullopt;
    if (containedIn(moved)) return std::nullopt;
    return found.nearest_points[0].template cast<double>();
  };
  return ShapeExit(meshOf(o.mesh), o.X_WM.template cast<double>(), toSolid(o.other),
                   o.X_WO.template cast<double>(), prove_apart)
      .run(std::numeric_limits<S>::epsilon());
}

}  // namespace

double kernelError(const shape::Solid* shape, double length) {
  if (!shape) return 0x1p-41 * length;
  if (shape->kind == shape::Kind::kConvex && shape->num_faces == 0) return 0x1p-28 * length;
  double least = length;
  for (int i = 0; shape->kind == shape::Kind::kEllipsoid && i < 3; ++i) {
    if (!shape::isFlat(shape->half, i)) least = std::min(least, shape->half[i]);
  }
  return 0x1p-41 * length * (length / least);
}

template <typename S>
std::size_t MeshAndOther<S>::collideSolids(const fcl::CollisionRequest<S>& request,
                                           fcl::CollisionResult<S>& result) const {
  const std::size_t before = result.numContacts();
  collideSurfaces(request, result);
  if (result.numContacts() > before || before >= request.num_max_contacts) {
    return result.numContacts();
  }
  if (!mesh.isOccupied() || !other.isOccupied()) return result.numContacts();
  const std::optional<fcl::Vector3<S>> point = containedIn(*this);
  if (!point) return result.numContacts();
  fcl::Contact<S> contact(&mesh, &other, kNone, kNone, *point, fcl::Vector3<S>::Zero(), S(0));
  if (request.enable_contact) {
    const PenetrationResult way = wayOut(*this);
    if (way.upper > 0) {
      contact.normal = roundedTo<S>(way.translation / way.upper);
      contact.penetration_depth = roundedTo<S>(way.upper);
    }
  }
  result.addContact(contact);
  return result.numContacts();
}

template <typename S>
S MeshAndOther<S>::distanceSolids(const fcl::DistanceRequest<S>& request,
                                  fcl::DistanceResult<S>& result) const {
  if (request.isSatisfied(result)) {
    distanceSurfaces(request, result);  // checks the arguments, and does nothing else
    return result.min_distance;
  }
  fcl::DistanceResult<S> found(result.min_distance);
  distanceSurfaces(request, found);
  const bool meet = found.min_distance <= 0;
  const std::optional<fcl::Vector3<S>> point = meet ? std::nullopt : containedIn(*this);
  if (!meet && !point) {
    result.update(found);
    return result.min_distance;
  }
  if (request.enable_signed_distance) {
    const PenetrationResult way = wayOut(*this);
    if (roundedTo<S>(way.upper) > 0) {
      const fcl::Vector3<S> end = roundedTo<S>(way.point);
      result.update(-roundedTo<S>(way.upper), &mesh, &other, meet ? found.b1 : kNone,
                    meet ? found.b2 : kNone, end, end - roundedTo<S>(way.translation));
      return result.min_distance;
    }
  }
  if (meet) {
    result.update(found);
  } else if (request.enable_nearest_points) {
    result.update(S(0), &mesh, &other, kNone, kNone, *point, *point);
  } else {
    result.update(S(0), &mesh, &other, kNone, kNone);
  }
  return result.min_distance;
}

template struct MeshAndOther<double>;
template struct MeshAndOther<float>;

}  // namespace kios
