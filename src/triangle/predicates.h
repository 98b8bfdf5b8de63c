// SPDX-FileCopyrightText: 2026 The fcl_kios authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <array>
#include <cmath>

#include "fcl_kios/triangle.h"

namespace kios {

/// The corner that follows each.
inline constexpr int kNext[3] = {1, 2, 0};

/// Exact signs of determinants of the six vertices of a pair of triangles (a: 0 to 2, b: 3 to 5).
/// Coordinates must be finite.
class PairPredicates {
 public:
  using Coordinates = std::array<std::array<double, 3>, 6>;

  explicit PairPredicates(const Coordinates& points);

  /// Sign of det(p_i - p_l, p_j - p_l, p_k - p_l).
  int orient3d(int i, int j, int k, int l) const;
  /// orient3d(i, j, k, l) of three points i.
  std::array<int, 3> sides(const int (&points)[3], int j, int k, int l) const;
  /// Sign of the area of (i, j, k) in the projection along `axis`.
  int orient2d(int i, int j, int k, int axis) const { return cross2d(i, j, i, k, axis); }
  /// The axis along which the projection of (i, j, k) has an area, -1 if there is none.
  int projectionAxis(int i, int j, int k) const;
  /// Sign of component `axis` of (p_j - p_i) x (p_l - p_k).
  int cross2d(int i, int j, int k, int l, int axis) const {
    const Filtered det = filteredCross2d(i, j, k, l, axis);
    return std::abs(det.value) > det.error ? signOf(det.value) : signOf(det, i, j, k, l, axis);
  }
  /// Returns the parameter from p_i at which p_i p_j crosses the plane of (k, l, m), on whose two
  /// sides they lie, to about 8 eps of the segment however small the angle is.
  double crossing3d(int i, int j, int k, int l, int m) const;
  /// Returns it for the line p_k p_l in the projection along `axis`.
  double crossing2d(int i, int j, int k, int l, int axis) const;
  /// Coordinate `axis` of p_i <= that of p_j.
  bool notAbove(int i, int j, int axis) const { return given_[i][axis] <= given_[j][axis]; }

 private:
  /// A determinant by plain arithmetic, and a bound of its error.
  struct Filtered {
    double value, error;
    bool vanishes;  ///< every product is 0; where none can underflow, so is the determinant
  };
  /// Minors of p_i - p_l in orient3d(i, j, k, l), and the sizes of their terms.
  struct Plane {
    int origin;
    double minors[3], sizes[3];
  };
  Plane planeOf(int j, int k, int l) const;
  Filtered orient3d(int i, const Plane& plane) const;
  // The filter: |det - exact| <= (3 + 16 u) u permanent (Shewchuk).
  Filtered filteredCross2d(int i, int j, int k, int l, int axis) const {
    const int u = axis == 2 ? 0 : axis + 1, v = axis == 0 ? 2 : axis - 1;
    const double left = (scaled_[j][u] - scaled_[i][u]) * (scaled_[l][v] - scaled_[k][v]);
    const double right = (scaled_[j][v] - scaled_[i][v]) * (scaled_[l][u] - scaled_[k][u]);
    constexpr double kBound = 4 * 0x1p-53;
    return {left - right, kBound * (std::abs(left) + std::abs(right)) + 0x1p-800,
            left == 0 && right == 0};
  }
  static int signOf(double v) { return (v > 0) - (v < 0); }
  /// Signs where the filter isn't sure.
  int signOf(const Filtered& cross2d, int i, int j, int k, int l, int axis) const;
  int signOf(const Filtered& orient3d, int i, int j, int k, int l) const;

  /// Holds the value with the right sign, and nearly all digits: mantissa 2^exponent.
  struct Rounded {
    double mantissa;
    long exponent;
  };
  /// `margin`: how many times its error bound an early stage's result must be to be taken.
  Rounded exactOrient3d(int i, int j, int k, int l, double margin) const;
  Rounded exactCross2d(int i, int j, int k, int l, int axis, double margin) const;
  static double share(const Rounded& a, const Rounded& b);

  bool same(int i, int j) const { return given_[i] == given_[j]; }

  const Coordinates& given_;
  Coordinates scaled_;  ///< given_ times 2^scale_, largest magnitude within 2^+-200
  int scale_ = 0;
  bool none_underflows_;  ///< of the products that are not 0
  bool plain_exact_;      ///< plain doubles are exact, too
};

/// Floats are doubles: what follows is decided for these alone.
inline const TriangleVerticesd& widened(const TriangleVerticesd& t) { return t; }
inline TriangleVerticesd widened(const TriangleVertices<float>& t) {
  return {t[0].cast<double>(), t[1].cast<double>(), t[2].cast<double>()};
}

inline PairPredicates::Coordinates coordinatesOf(const TriangleVerticesd& a,
                                                 const TriangleVerticesd& b) {
  PairPredicates::Coordinates all;
  for (std::size_t i = 0; i < 3; ++i) {
    all[i] = {a[i][0], a[i][1], a[i][2]};
    all[3 + i] = {b[i][0], b[i][1], b[i][2]};
  }
  return all;
}

}  // namespace kios
