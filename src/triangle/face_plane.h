// SPDX-FileCopyrightText: 2026 The fcl_kios authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <Eigen/Core>
#include <cmath>

namespace kios {

/// A triangle by two orthogonal directions from one corner: its longest edge, and its height on it.
/// By Gram-Schmidt, twice: right to eps for any aspect, which a cross product is not.
class FacePlane {
 public:
  using Vec = Eigen::Vector3d;

  FacePlane() = default;  ///< is not to be asked
  explicit FacePlane(const Vec (&face)[3]) {
    int longest = 0;
    edge2_ = -1;
    for (int k = 0; k < 3; ++k) {
      const double s = (face[(k + 1) % 3] - face[k]).squaredNorm();
      if (s > edge2_) {
        edge2_ = s;
        longest = k;
      }
    }
    corner_ = face[longest];
    edge_ = face[(longest + 1) % 3] - corner_;
    height_ = face[(longest + 2) % 3] - corner_;
    foot_ = removePart(edge_, edge2_, height_);
    foot_ += removePart(edge_, edge2_, height_);
    height2_ = height_.squaredNorm();
  }

  /// Sets `residual` to the part of point - plane that is orthogonal to the plane. True if the
  /// point's foot lies in the triangle; false if the triangle has no plane.
  bool project(const Vec& point, Vec& residual) const {
    residual = point - corner_;
    double s = removePart(edge_, edge2_, residual), c = removePart(height_, height2_, residual);
    s += removePart(edge_, edge2_, residual);
    c += removePart(height_, height2_, residual);
    s += removePart(edge_, edge2_, residual);
    const double side = s - c * foot_;
    return height2_ > 0 && c >= 0 && side >= 0 && side + c <= 1;
  }

  /// How far the triangle and a point extend from the corner.
  double extentTo(const Vec& point) const {
    return std::sqrt(edge2_) + (point - corner_).lpNorm<Eigen::Infinity>();
  }

 private:
  /// Removes from v its part along a direction, returns that part in directions: all of v where the
  /// direction is 0, so that nothing is to be trapped.
  static double removePart(const Vec& direction, double square, Vec& v) {
    const double t = v.dot(direction) / (square > 0 ? square : 1.0);
    v -= t * direction;
    return t;
  }

  Vec corner_, edge_, height_;
  double edge2_, height2_;  ///< their squares
  double foot_;             ///< of the height, in edges from the corner
};

}  // namespace kios
