// SPDX-FileCopyrightText: 2026 The fcl_kios authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <array>

#include "fcl_kios/volume.h"
#include "volume/balls.h"

namespace kios::exact {

using fcl::Matrix3d;
using fcl::Vector3d;

/// A k-IOS taken apart into what its boundary consists of: spheres, the circles in which two of
/// them meet, and the vertices in which three do. Lengths are in units of 2^exponent() in which the
/// farthest sphere reaches about 1, relative to S0's centre. Built once a volume; poses come later.
class SphereIntersection {
 public:
  static constexpr int kSpheres = kIOS<double>::kMaxSpheres;
  static constexpr int kCircles = kSpheres * (kSpheres - 1) / 2;
  static constexpr int kVertices = kSpheres * (kSpheres - 1) * (kSpheres - 2) / 3;

  /// The volume must not be empty.
  template <typename S>
  explicit SphereIntersection(const kIOS<S>& volume);

  int exponent() const { return exponent_; }
  /// >= |centre| + radius of every sphere; 0 for a point.
  double reach() const { return reach_; }

  /// The point that lies farthest along a direction v, and why: the normals n_i of the spheres that
  /// hold it there, sum n_i = v. By duality v.x <= sum (n_i.c_i + r_i |n_i|) for every x of the
  /// body, whatever the n_i: the proof of a bound doesn't depend on how they were found.
  struct Extreme {
    Vector3d x = Vector3d::Zero();
    int active = 0;
    std::array<int, 3> sphere = {};
    std::array<Vector3d, 3> part;
    double violation = 0;  ///< by how much x lies outside the worst sphere, 0 or rounding
    /// Derivative of x by v: the Hessian of the support function.
    Matrix3d curvature = Matrix3d::Zero();
  };
  /// v need not have unit length, but isn't 0.
  Extreme support(const Vector3d& v) const;

  /// >= v.x for every x of the body in exact arithmetic.
  double supportBound(const Vector3d& v, const Extreme& extreme) const;

  /// max |x - c_i| - r_i over the spheres.
  double violation(const Vector3d& x) const;

  struct Sphere {
    Vector3d c;
    double r;
  };
  int spheres() const { return spheres_; }
  const Sphere& sphere(int i) const { return sphere_[i]; }

 private:
  /// Spheres i and j meet at right angles to `axis` (unit, from i to j), height_i from i's centre
  /// and height_j from j's (signed, their sum is the distance of the centres).
  struct Circle {
    int i, j;
    Vector3d center, axis;
    double radius, height_i, height_j;
  };
  struct Vertex {
    std::array<int, 3> sphere;
    Vector3d x;
    Matrix3d rays;         ///< columns x - c_i
    Matrix3d to_multiple;  ///< inverse of rays
  };

  void addCircle(int i, int j);
  void addVertices(int i, int j, int k);
  void addVertex(int i, int j, int k, Vector3d x);
  int exponent_ = 0;
  double reach_ = 0;
  int spheres_ = 0, circles_ = 0, vertices_ = 0;
  std::array<Sphere, kSpheres> sphere_;
  std::array<Circle, kCircles> circle_;
  std::array<Vertex, kVertices> vertex_;
};

}  // namespace kios::exact
