// SPDX-FileCopyrightText: 2026 The fcl_kios authors
// SPDX-License-Identifier: BSD-3-Clause
#include "scene/body.h"

#include <cmath>
#include <utility>

#include "model/kios_model.h"
#include "model/shape_values.h"
#include "volume/errors.h"
#include "volume/instantiate.h"
#include "volume/rotation.h"
#include "volume/rounding.h"

namespace kios::scene {
namespace {

/// Returns the square of the Frobenius norm of R^T R - I. Throws if the pose can't be queried.
template <typename S>
double requireRigid(const fcl::Transform3<S>& X) {
  const auto& R = X.linear();
  const auto& t = X.translation();
  const auto entries = [&R](int i, int j) { return double{R(i, j)}; };
  const double square = squaredRotationError(entries);
  requireRotation<S>(square, determinant(entries), "pose of an object of the scene");
  const double size = std::abs(double{t[0]}) + std::abs(double{t[1]}) + std::abs(double{t[2]});
  if (!(size <= kMaxCoordinate<S> / 4)) {
    refuse("the translation of an object of the scene is NaN, infinite or too large.");
  }
  return square;
}

template <typename S>
void setPose(Body<S>& body, const fcl::Transform3<S>& X_W, double rotation_square) {
  body.X_W = X_W;
  body.rotation_square = rotation_square;
  // A power of two, so that it stays the same while rounding errors come and go.
  body.rotation_error = std::ldexp(1.0, std::ilogb(std::sqrt(rotation_square) + 0x1p-48) + 1);
}

template <typename S>
bool samePose(const fcl::Transform3<S>& a, const fcl::Transform3<S>& b) {
  return a.linear() == b.linear() && a.translation() == b.translation();
}

template <typename S>
Sphere sphereOf(const kIOS<S>& root) {
  const fcl::Vector3<S>& c = root.center0;
  return {{double{c[0]}, double{c[1]}, double{c[2]}}, double{root.radius0}};
}

/// Returns FCL's own local AABB, which place() and renew() made afresh. Its radius has no margin,
/// and FCL's GJK is off by up to its tolerance, 1e-6, so that distances may come out smaller.
template <typename S>
Sphere sphereOf(const fcl::CollisionGeometry<S>& geometry) {
  const double radius = geometry.aabb_radius * (1 + 1e-4) + 1e-5;
  const auto& c = geometry.aabb_center;
  if (!(std::isfinite(radius) && c.allFinite())) return {{0, 0, 0}, kInfinity};
  return {{double{c[0]}, double{c[1]}, double{c[2]}}, radius};
}

// A sphere of the world is around X c. R stretches by at most 1 + |E|. The
// distance that the narrow phase computes, in the first body's frame, differs from the distance d
// in the world by at most: |E| (d + reach) from a frame that isn't orthonormal; the triangles'
// error, of an extent of at most 1.74 (d
// + 2 r + 2 r'); the common frame's, for |x'|_1 <= 2 reach' and |T|_1 <= 1.74 |t' - t|, which is at
// most 1.74 (d + reach + reach'). The terms in d are boxShare()'s, the rest is split over the
// boxes.
template <typename S>
Box boxOf(const Body<S>& body) {
  Box box = {{-kInfinity, -kInfinity, -kInfinity}, {kInfinity, kInfinity, kInfinity}};
  const Sphere& sphere = body.sphere;
  if (!(sphere.radius < kInfinity)) return box;
  const double error = body.rotation_error;
  const double pads = 2 * error * body.reach +
                      error_bounds::triangleError<S>(error_bounds::extentOf(0, sphere.radius, 0)) +
                      error_bounds::frameError<S>(2 * body.reach, 1.74 * body.reach);
  for (int i = 0; i < 3; ++i) {
    double at = double{body.X_W.translation()[i]}, terms = std::abs(at);
    for (int j = 0; j < 3; ++j) {
      const double term = double{body.X_W.linear()(i, j)} * sphere.center[j];
      at += term;
      terms += std::abs(term);
    }
    const double r =
        (sphere.radius * (1 + error) + pads + error_bounds::sumError<double>(terms) + 0x1p-1000) *
        (1 + 0x1p-50);
    box.lower[i] = at - r;
    box.upper[i] = at + r;
  }
  return box;
}

}  // namespace

template <typename S>
void renew(Body<S>& body) {
  if (body.model) {
    body.shape = false;
    body.state = stateOf(*body.model);
    body.sphere = sphereOf(body.model->getBV(0).bv);
  } else {
    // As fcl::CollisionObject does at its construction.
    const_cast<fcl::CollisionGeometry<S>&>(*body.geometry).computeLocalAABB();
    body.shape = isShapeOfFcl(*body.geometry);
    if (body.shape) body.shape_values = shapeValues(*body.geometry);
    body.sphere = sphereOf(*body.geometry);
  }
  body.reach = body.sphere.reach();
  body.generation = nextGeneration();
  body.box = boxOf(body);
}

template <typename S>
void place(Body<S>& body, std::shared_ptr<const fcl::CollisionGeometry<S>> geometry,
           const fcl::Transform3<S>& X_W) {
  if (!geometry) refuse("the geometry of an object of the scene is null.");
  const double rotation_square = requireRigid(X_W);
  const auto* const model = dynamic_cast<const Model<S>*>(geometry.get());
  if (model) requireFinished(*model);
  body.geometry = std::move(geometry);
  body.model = model;
  setPose(body, X_W, rotation_square);
  renew(body);
}

template <typename S>
void move(Body<S>& body, const fcl::Transform3<S>& X_W) {
  if (samePose(body.X_W, X_W)) return;
  const double rotation_square = requireRigid(X_W);
  ++body.pose;
  setPose(body, X_W, rotation_square);
  body.box = boxOf(body);
}

template <typename S>
void renewIfChanged(Body<S>& body) {
  if (body.model) {
    requireFinished(*body.model);
    if (!(stateOf(*body.model) == body.state)) renew(body);
  } else if (body.shape && !hasShapeValues(*body.geometry, body.shape_values)) {
    renew(body);
  }
}

template <typename S>
void follow(Body<S>& body) {
  const fcl::CollisionObject<S>& object = *body.followed;
  if (object.collisionGeometry() == body.geometry) {
    move(body, object.getTransform());
  } else {
    place<S>(body, object.collisionGeometry(), object.getTransform());
  }
}

KIOS_INSTANTIATE_FUNCTION(place);
KIOS_INSTANTIATE_FUNCTION(move);
KIOS_INSTANTIATE_FUNCTION(renew);
KIOS_INSTANTIATE_FUNCTION(renewIfChanged);
KIOS_INSTANTIATE_FUNCTION(follow);

}  // namespace kios::scene
