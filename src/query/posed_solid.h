// SPDX-FileCopyrightText: 2026 The fcl_kios authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "fcl_kios/model/model.h"
#include "fcl_kios/triangle/triangle.h"
#include "fcl_kios/volume/kios.h"
#include "shape/solid.h"
#include "volume/balls.h"

namespace kios {

/// A solid and the pose of a mesh in the solid's frame, in which all is evaluated, in double. The
/// pose is x -> R2^T (R1 x + (t1 - t2)), 1 the mesh and 2 the solid: the common frame of
/// docs/guarantees.md with the solid as the first object. Beyond 2^100 and below 2^-100 lengths are
/// in units of a power of two, so that no square over- or underflows; else the unit is 1.
template <typename S>
class PosedSolid {
 public:
  /// `root` is the mesh's root volume. Throws std::invalid_argument if a pose is not rigid.
  PosedSolid(shape::Solid solid, const fcl::Transform3<S>& X_WM, const fcl::Transform3<S>& X_WS,
             const kIOS<S>& root);
  /// Takes rotations that were checked: `squared_errors` is squaredRotationErrors(X_WS, X_WM).
  PosedSolid(shape::Solid solid, const fcl::Transform3<S>& X_WM, const fcl::Transform3<S>& X_WS,
             const kIOS<S>& root, double squared_errors);

  /// The solid, in units.
  const shape::Solid& solid() const { return solid_; }
  /// Its Solid::reach(), in units.
  double reach() const { return reach_; }
  /// The box of a bounded solid's core, in its frame.
  const shape::Range& range() const { return range_; }
  /// The pose x -> R x + T of the mesh in the solid's frame, in units of 1 only if hasUnit1().
  const Eigen::Matrix3d& R() const { return R_; }
  const shape::Vec& T() const { return T_; }
  bool hasUnit1() const { return per_unit_ == 1; }
  double stretch() const { return stretch_; }
  /// A length in units, and back; the latter not to 0 from above.
  double toUnits(double length) const { return length * per_unit_; }
  S fromUnits(double length) const;

  /// A point or triangle of the mesh, in the solid's frame and units.
  shape::Vec place(const fcl::Vector3<S>& x_M) const {
    return R_ * (x_M.template cast<double>() * per_unit_) + T_;
  }
  TriangleVertices<double> place(const TriangleVertices<S>& t) const {
    return {place(t[0]), place(t[1]), place(t[2])};
  }
  /// A point of the solid's frame, in units, to the world; a direction likewise.
  fcl::Vector3<S> toWorld(const shape::Vec& p) const;
  fcl::Vector3<S> directionToWorld(const shape::Vec& n) const;

  /// Half of what computed distances and bounds of the mesh's triangles may be off by; `root` is
  /// its root volume.
  double kernelError(const kIOS<S>& root) const;
  /// The spheres of a volume of the mesh in the solid's frame and units, grown by all that
  /// rounds, so that each contains the posed content however that is rounded. Returns k.
  int placeSpheres(const kIOS<S>& bv, Ball* spheres) const;

 private:
  shape::Solid solid_;
  Eigen::Matrix3d R_, R_WS_;
  shape::Vec T_, t_WS_;
  double per_unit_ = 1, unit_ = 1;
  double stretch_;      ///< |R|_2 - 1 <= stretch
  double reach_;        ///< of the solid, in units
  double offsets_;      ///< |T|_1 + the solid's reach
  shape::Range range_;  ///< of a bounded solid's core, in units
};

/// True only if a finished model is farther than `margin` >= 0 from one of FCL's nine shapes, told
/// by its root; false says nothing. `squared_errors` is squaredRotationErrors(X_WS, X_WM). Throws
/// std::invalid_argument if a size of the shape is none; a convex shape with such a vertex, or
/// without any, gives false.
template <typename S>
bool provenApart(const Model<S>& model, const fcl::Transform3<S>& X_WM,
                 const fcl::CollisionGeometry<S>& shape, const fcl::Transform3<S>& X_WS,
                 double squared_errors, double margin);

}  // namespace kios
