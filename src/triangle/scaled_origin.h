// SPDX-FileCopyrightText: 2026 The fcl_kios authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <algorithm>
#include <cmath>

#include "fcl_kios/triangle.h"
#include "volume/rounding.h"

namespace kios {

/// Holds a ray's origin in units of a power of two, in which no product of coordinates over- or
/// underflows.
class ScaledOrigin {
 public:
  /// `largest`: about the largest coordinate of the triangles.
  ScaledOrigin(const Point<double>& origin, double largest) {
    largest = std::max(largest, origin.cwiseAbs().maxCoeff());
    const bool ordinary = largest >= 0x1p-200 && largest <= 0x1p200;
    if (!ordinary && largest > 0) exponent_ = std::clamp(-std::ilogb(largest), -1000, 1000);
    unit_ = std::ldexp(1.0, exponent_);
    for (int c = 0; c < 3; ++c) {
      origin_[c] = origin[c] * unit_;
      exact_ &= origin_[c] / unit_ == origin[c];
    }
  }

  double operator[](int c) const { return origin_[c]; }
  int exponent() const { return exponent_; }  ///< units are of 2^-exponent

  /// Holds a triangle in these units.
  struct Corners {
    double corner[3][3];
    double from_origin[3][3];  ///< rounded
  };
  /// Returns false if digits of the origin or of a corner are lost.
  bool scale(const TriangleVertices<double>& corners, Corners& t) const {
    bool exact = exact_;
    for (int i = 0; i < 3; ++i) {
      for (int c = 0; c < 3; ++c) {
        t.corner[i][c] = corners[i][c] * unit_;
        exact &= unit_ == 1 || t.corner[i][c] / unit_ == corners[i][c];
        t.from_origin[i][c] = t.corner[i][c] - origin_[c];
      }
    }
    return exact;
  }

 private:
  double origin_[3], unit_;
  int exponent_ = 0;
  bool exact_ = true;
};

/// Names the sign of a determinant: kUnknown where rounding might have made it.
enum Sign { kMinus = -1, kZero = 0, kPlus = 1, kUnknown = 2 };

}  // namespace kios
