// SPDX-FileCopyrightText: 2026 The fcl_kios authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <utility>

#include "fcl_kios/detail/rigid.h"
#include "fcl_kios/triangle.h"
#include "fcl_kios/volume.h"
#include "search/mesh.h"
#include "shape/solid.h"
#include "volume/rotation.h"

namespace kios {

/// A solid and the pose of a mesh in the solid's frame, in which all is evaluated, in double: the
/// common frame of docs/guarantees.md with the solid as the first object. Beyond 2^100 and below
/// 2^-100 lengths are in units of a power of two, so that no square over- or underflows; else the
/// unit is 1.
class PosedSolid {
 public:
  /// Throws std::invalid_argument if a pose, in double or float, is not rigid.
  template <typename P>
  PosedSolid(shape::Solid solid, const fcl::Transform3<P>& X_WM, const fcl::Transform3<P>& X_WS,
             const Mesh& mesh)
      : PosedSolid(std::move(solid), X_WM, X_WS, mesh, squaredRotationErrors(X_WS, X_WM)) {}
  /// Takes rotations that were checked: `squared_errors` is squaredRotationErrors(X_WS, X_WM).
  template <typename P>
  PosedSolid(shape::Solid solid, const fcl::Transform3<P>& X_WM, const fcl::Transform3<P>& X_WS,
             const Mesh& mesh, double squared_errors)
      : solid_(std::move(solid)),
        X_WS_(X_WS.template cast<double>()),
        X_SM_(X_WS, X_WM, squared_errors) {
    setUnit(mesh);
  }

  /// The solid, in units.
  const shape::Solid& solid() const { return solid_; }
  /// Its Solid::reach(), in units.
  double reach() const { return reach_; }
  /// The box of a bounded solid's core, in its frame.
  const shape::Range& range() const { return range_; }
  /// The pose x -> R x + T of the mesh in the solid's frame, in units of 1 only if hasUnit1().
  const Eigen::Matrix3d& R() const { return X_SM_.R(); }
  const shape::Vec& T() const { return T_; }
  bool hasUnit1() const { return per_unit_ == 1; }
  double stretch() const { return detail::boundsOf(X_SM_).stretch; }
  /// A length in units, and back; the latter not to 0 from above.
  double toUnits(double length) const { return length * per_unit_; }
  double fromUnits(double length) const;

  /// A point or triangle of the mesh, in the solid's frame and units.
  shape::Vec place(const Pointd& x_M) const {
    return detail::rotate<double>(R(), x_M * per_unit_) + T_;
  }
  TriangleVerticesd place(const TriangleVerticesd& t) const {
    return {place(t[0]), place(t[1]), place(t[2])};
  }
  /// A point of the solid's frame, in units, to the world; a direction likewise.
  Pointd toWorld(const shape::Vec& p) const;
  Pointd directionToWorld(const shape::Vec& n) const;

  /// Half of what computed distances and bounds of the mesh's triangles may be off by.
  double kernelError(const Mesh& mesh) const;

 private:
  void setUnit(const Mesh& mesh);

  shape::Solid solid_;
  fcl::Transform3d X_WS_;
  RelativePosed X_SM_;
  shape::Vec T_;  ///< its translation, in units
  double per_unit_ = 1, unit_ = 1;
  double reach_;        ///< of the solid, in units
  double offsets_;      ///< |T|_1 + the solid's reach
  shape::Range range_;  ///< of a bounded solid's core, in units
};

/// True only if the roots prove a finished model farther than `margin` >= 0 from a solid; false
/// says nothing. `squared_errors` is squaredRotationErrors(X_WS, X_WM).
template <typename S>
bool provenApart(const Mesh& mesh, const fcl::Transform3<S>& X_WM, const shape::Solid& solid,
                 const fcl::Transform3<S>& X_WS, double squared_errors, double margin);

}  // namespace kios
