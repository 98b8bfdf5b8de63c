// SPDX-FileCopyrightText: 2026 The fcl_kios authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cmath>
#include <cstdint>
#include <memory>
#include <vector>

#include <fcl/geometry/collision_geometry.h>
#include <fcl/narrowphase/collision_object.h>
#include "fcl_kios/model/model.h"
#include "fcl_kios/scene/scene_types.h"
#include "model/prepared.h"
#include "scene/box.h"
#include "volume/error_bounds.h"

namespace kios::scene {

/// Holds a sphere around a content, in its body's frame.
struct Sphere {
  double center[3] = {0, 0, 0};
  double radius = 0;

  /// Returns a bound >= |y| of every y in it.
  double reach() const {
    return (std::abs(center[0]) + std::abs(center[1]) + std::abs(center[2]) + radius) *
           (1 + 0x1p-48);
  }
};

/// Holds an object of a scene as the last query found it.
template <typename S>
struct Body {
  // These members come first, as every query reads them in every body.

  /// Is unlike that of any other geometry, or of the same one changed; 0 is that of no object.
  std::uint64_t generation = 0;
  std::uint64_t pose = 0;      ///< counts poses of this generation
  double rotation_error = 0;   ///< >= |R^T R - I|_2
  double rotation_square = 0;  ///< the square of |R^T R - I| (Frobenius)
  /// Is a box around the content in the world, so wide that the gap of two bodies' boxes, less a
  /// share boxShare() of it, is at most the distance that the narrow phase would compute.
  Box box;
  const fcl::CollisionObject<S>* followed = nullptr;  ///< where geometry and pose are read, if set
  Role role = Role::kBody;
  bool shape = false;  ///< one of FCL's, whose sizes are compared at each query

  std::shared_ptr<const fcl::CollisionGeometry<S>> geometry;
  const Model<S>* model = nullptr;  ///< the geometry if it is a mesh over k-IOS
  ModelState state;                 ///< of a mesh as it was measured
  std::vector<S> shape_values;      ///< likewise of a shape; see model/shape_values.h
  fcl::Transform3<S> X_W = fcl::Transform3<S>::Identity();
  Sphere sphere;     ///< around the content, infinite for planes and the like
  double reach = 0;  ///< the sphere's

  bool used() const { return generation != 0; }
  /// A change of the geometry is seen. It is not of octrees and of the user's classes, of which
  /// nothing is remembered.
  bool watched() const { return model != nullptr || shape; }
};

/// Makes the body that of a geometry at a pose.
template <typename S>
void place(Body<S>& body, std::shared_ptr<const fcl::CollisionGeometry<S>> geometry,
           const fcl::Transform3<S>& X_W);

/// Moves the body. Throws std::invalid_argument if the pose is not rigid; the body then is as it
/// was.
template <typename S>
void move(Body<S>& body, const fcl::Transform3<S>& X_W);

/// Measures the body's geometry anew, which has changed.
template <typename S>
void renew(Body<S>& body);

/// Does so if the body is a mesh or a shape that has changed. Throws std::invalid_argument if a
/// mesh is not finished.
template <typename S>
void renewIfChanged(Body<S>& body);

/// Brings the body up to date with its fcl::CollisionObject.
template <typename S>
void follow(Body<S>& body);

/// See Body::box: `error` is the largest rotation error of the scene.
template <typename S>
double boxShare(double error) {
  return 2 * error + error_bounds::triangleError<S>(error_bounds::extentOf(1, 0, 0)) +
         error_bounds::frameError<S>(0, 1.74);
}

}  // namespace kios::scene
