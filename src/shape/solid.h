// SPDX-FileCopyrightText: 2026 The fcl_kios authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <Eigen/Geometry>
#include <vector>

#include "fcl_kios/triangle.h"
#include "shape/point_rows.h"

namespace kios::shape {

using Vec = Point<double>;

enum class Kind {
  kSphere,
  kCapsule,
  kBox,
  kEllipsoid,
  kCylinder,
  kCone,
  kConvex,
  kHalfspace,
  kPlane
};

/// A closed, full shape in its own frame, as FCL places it: centred at the origin, capsule,
/// cylinder and cone along z, the cone's apex at +z. Lengths are in any one unit, finite and not
/// negative; zero ones are allowed (a disk, a segment, a point).
struct Solid {
  Kind kind = Kind::kSphere;
  Vec half = Vec::Zero();  ///< box: half extents; ellipsoid: radii
  double radius = 0;       ///< sphere, capsule, cylinder, cone
  double half_length = 0;  ///< along z: capsule (its segment), cylinder, cone
  Vec normal =
      Vec::Zero();  ///< half-space {normal x <= offset} and plane {normal x = offset}: unit
  double offset = 0;
  std::vector<Vec> points;  ///< convex: their hull is the shape
  PointRows rows;           ///< of these, if made by makeRows()
  /// Convex: the hull's faces, each the number of its corners and their indices, as FCL's. Not
  /// owned. They decide where GJK can't.
  const int* faces = nullptr;
  int num_faces = 0;

  /// Half-spaces and planes have no support points, and no size.
  bool bounded() const { return kind != Kind::kHalfspace && kind != Kind::kPlane; }
  /// The shape is its core, grown by this: spheres are points, capsules segments.
  double margin() const { return kind == Kind::kSphere || kind == Kind::kCapsule ? radius : 0.0; }
  /// Largest distance of a point of the shape from the origin; that of the plane for unbounded
  /// ones.
  double reach() const;
};

/// A box along the axes.
struct Range {
  Vec low, high;
};
/// The box around the core of a bounded shape.
Range rangeOf(const Solid& solid);

/// True if an ellipsoid's radius counts as 0, since its square may vanish beside that of the
/// largest.
inline bool isFlat(const Vec& radii, int axis) {
  return radii[axis] <= 0x1p-100 * radii.maxCoeff();
}

/// Makes the rows of a convex shape's points, by which those that are extreme are found sooner if
/// there are more than a few. Points mustn't change thereafter.
void makeRows(Solid& solid);

/// A point of the core that is extreme along n (bounded shapes; n need not be unit).
Vec coreSupport(const Solid& solid, const Vec& n);

/// max n x over the whole shape, n unit; +infinity where a half-space or plane has none.
double extentAlong(const Solid& solid, const Vec& n);

/// Lower bound of the distance of p to the shape, exact but for rounding for all kinds except the
/// convex shape; not above 0 inside (for a plane: never negative). Error by rounding: below 2^-48
/// (|p|_1 + reach).
double pointBound(const Solid& solid, const Vec& p);

}  // namespace kios::shape
