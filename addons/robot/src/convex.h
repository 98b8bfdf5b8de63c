// SPDX-FileCopyrightText: 2026 The fcl_kios authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <fcl/geometry/collision_geometry.h>

// FCL's bounded shapes by their support points: FCL's own distance of two shapes is right to 1e-6,
// which is too coarse for a derivative, and proves nothing.

namespace kios::robot {

/// The geometry as the shape that its node type names.
template <typename Shape>
const Shape& as(const fcl::CollisionGeometryd& geometry) {
  return static_cast<const Shape&>(geometry);
}

/// A bounded shape in the world: its core, grown by a margin.
class Convex {
 public:
  /// The geometry must be one of FCL's shapes but half-space and plane.
  Convex(const fcl::CollisionGeometryd& shape, const fcl::Transform3d& X_WS)
      : shape_(shape), X_(X_WS) {}

  /// The point of the core that is farthest along n.
  fcl::Vector3d support(const fcl::Vector3d& n) const;
  double margin() const;
  const fcl::Vector3d& center() const { return center_; }

 private:
  const fcl::CollisionGeometryd& shape_;
  fcl::Transform3d X_;
  fcl::Vector3d center_ = X_.translation();
};

/// Nearest points of two, and a bracket of their distance.
struct ConvexDistance {
  double distance = 0;  ///< 0 at overlap; from above, but for its own rounding
  double lower = 0;     ///< by a separating slab; 0 where none was found
  fcl::Vector3d point_a = fcl::Vector3d::Zero(), point_b = fcl::Vector3d::Zero();
};

/// Distance of two convex shapes: GJK, with a slab that certifies the lower bound. The bracket
/// closes to rounding for shapes with corners, and to about 1e-9 of the size for round ones.
/// Source: Gilbert, Johnson & Keerthi (1988); the duality gap as in van den Bergen (1999).
ConvexDistance convexDistance(const Convex& a, const Convex& b);

/// From a half-space {n x <= offset} or, if `thin`, a plane to a convex shape.
ConvexDistance planeDistance(const fcl::Vector3d& normal, double offset, bool thin,
                             const Convex& b);

}  // namespace kios::robot
