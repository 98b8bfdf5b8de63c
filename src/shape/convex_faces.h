// SPDX-FileCopyrightText: 2026 The fcl_kios authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <vector>

#include "shape/triangle_shape.h"

namespace kios::shape {

/// The planes of a convex shape's faces, made once for a query about many triangles. What they tell
/// doesn't rest on the faces: all points lie behind each plane, and what is told to be inside lies
/// in a tetrahedron of a face and the points' middle. For one thread.
class ConvexFaces {
 public:
  /// None for other solids, for those without faces, and where there are so many of them that
  /// making planes doesn't pay. The solid must outlive this.
  explicit ConvexFaces(const Solid& solid);

  bool known() const { return offsets_.size() > 0; }
  std::size_t size() const { return faces_.size(); }
  /// All points lie in {normal x <= offset}; the normal has length 1 and leads outwards.
  Vec normal(std::size_t i) const { return normals_.row(static_cast<Eigen::Index>(i)); }
  double offset(std::size_t i) const { return offsets_[static_cast<Eigen::Index>(i)]; }

  enum class Verdict { kApart, kMeets, kOpen };
  /// By the planes alone.
  Verdict judge(const Triangle& triangle) const;

  /// True if p is proven to lie in the shape.
  bool contains(const Vec& p) const;

  /// The face by which a triangle leaves the hull on the shortest way; there must be one.
  std::size_t leastExit(const Triangle& triangle) const;

 private:
  bool inTetrahedra(std::size_t face, const Vec& p) const;

  /// Heights of a point over all planes, evaluated where they are used.
  auto above(const Vec& p) const {
    return (p.x() * normals_.col(0).array() + p.y() * normals_.col(1).array() +
            p.z() * normals_.col(2).array()) -
           offsets_;
  }

  const Solid& solid_;
  std::vector<const int*> faces_;  ///< as in Solid::faces
  Eigen::Matrix<double, Eigen::Dynamic, 3> normals_;
  Eigen::ArrayXd offsets_;
  Eigen::ArrayXd depths_;         ///< of the middle under the planes
  mutable std::size_t last_ = 0;  ///< whose tetrahedra held a point of late
  Vec middle_ = Vec::Zero();
  double reach_ = 0;
};

}  // namespace kios::shape
