// SPDX-FileCopyrightText: 2026 The fcl_kios authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <vector>

#include "shape/triangle_shape.h"

namespace kios::shape {

/// The planes of a convex shape's faces, made once for a query. What they tell doesn't rest on the
/// faces: a slab is one of all points, and what is told to be inside lies in a tetrahedron of a
/// face and the points' middle. Where GJK decides what meets, and the kernels alone keep slabs,
/// shapes/convex contacts takes 2.4 times as long. For one thread.
class ConvexFaces {
 public:
  /// Takes all faces with an area; other solids have none. The solid must outlive this.
  explicit ConvexFaces(const Solid& solid);

  bool known() const { return offsets_.size() > 0; }

  /// All points lie in {normal x <= offset}; the normal has length 1 and leads outwards.
  struct Slab {
    Vec normal;
    double offset;
  };
  /// Those of all faces. Takes as long as faces times points.
  std::vector<Slab> slabs() const;
  /// That by which a triangle leaves the hull on the shortest way; there must be faces.
  Slab leastExit(const Triangle& triangle) const;

  enum class Verdict { kApart, kMeets, kOpen };
  /// By the planes alone.
  Verdict judge(const Triangle& triangle) const;

  /// True if p is proven to lie in the shape.
  bool contains(const Vec& p) const;

 private:
  bool inTetrahedra(std::size_t face, const Vec& p) const;
  /// The face over whose plane by offsets_ a triangle lies highest, and how high.
  Eigen::Index highestOver(const Triangle& t, double& height) const;
  Vec normal(Eigen::Index i) const { return normals_.row(i); }

  /// Along all normals, evaluated where it is used.
  auto along(const Vec& v) const {
    return v.x() * normals_.col(0).array() + v.y() * normals_.col(1).array() +
           v.z() * normals_.col(2).array();
  }
  const Solid& solid_;
  std::vector<const int*> faces_;  ///< as in Solid::faces; repeated up to a multiple of 8
  Eigen::Matrix<double, Eigen::Dynamic, 3> normals_;
  /// By one corner of each face, until leastExit() finds points beyond: thin faces lie askew.
  mutable Eigen::ArrayXd offsets_;
  Eigen::ArrayXd per_depth_;  ///< 1 / the middle's depths under the planes; none if flat
  mutable Eigen::ArrayXd heights_;
  mutable std::size_t last_ = 0;  ///< whose tetrahedra held a point of late
  Vec middle_ = Vec::Zero();
  double reach_ = 0;
};

}  // namespace kios::shape
