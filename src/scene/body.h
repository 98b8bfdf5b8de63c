// SPDX-FileCopyrightText: 2026 The fcl_kios authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cmath>
#include <cstdint>
#include <memory>
#include <optional>

#include <fcl/common/types.h>
#include "fcl_kios/scene.h"
#include "scene/box.h"
#include "search/mesh.h"
#include "volume/error_bounds.h"
#include "volume/rounding.h"

namespace kios::scene {

/// Holds a sphere around a content, in its body's frame.
struct Sphere {
  Pointd center = Pointd::Zero();
  double radius = 0;

  /// Returns a bound >= |y| of every y in it.
  double reach() const { return (center.lpNorm<1>() + radius) * (1 + 0x1p-48); }
};

class Content;

/// Holds an object of a scene as the last query found it.
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
  Role role = Role::kBody;
  /// A change of the geometry is seen. It is not of octrees and of the user's classes, of which
  /// nothing is remembered.
  bool watched = false;

  std::shared_ptr<Content> content;
  std::optional<Mesh> mesh;  ///< of a mesh over k-IOS
  fcl::Transform3d X_W = fcl::Transform3d::Identity();
  Sphere sphere;     ///< around the content, infinite for planes and the like
  double reach = 0;  ///< the sphere's

  bool used() const { return generation != 0; }
};

/// By which rounding to float moves a length near 0.
constexpr double kLeastFloat = 0x1p-149;

/// Sets the pose; `rotation_square` as in Body. The box is as it was.
void setPose(Body& body, const fcl::Transform3d& X_W, double rotation_square);

/// Sets the box by the pose and the sphere.
void setBox(Body& body);

/// See Body::box: `error` is the largest rotation error of the scene. Answers in float are rounded
/// from doubles.
inline double boxShare(double error) {
  return 2 * error + error_bounds::triangleError<double>(error_bounds::extentOf(1, 0, 0)) +
         error_bounds::frameError<double>(0, 1.74) + 2 * kUlpFloat;
}

}  // namespace kios::scene
