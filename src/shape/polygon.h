// SPDX-FileCopyrightText: 2026 The fcl_kios authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <algorithm>
#include <array>

#include "shape/triangle_shape.h"

namespace kios::shape {

/// A triangle cut to slabs |x_axis| <= h: a convex polygon, closed, perhaps without area.
struct Polygon {
  /// A cut adds one corner, and rounding might split another off: nine, and as many again.
  static constexpr int kMost = 18;
  int size = 0;
  std::array<Vec, kMost> corner;

  explicit Polygon(const Triangle& t) : size(3) { std::copy(t.begin(), t.end(), corner.begin()); }
  /// Cuts it to a box of half extents h.
  Polygon(const Triangle& t, const Vec& h) : Polygon(t) {
    for (int axis = 0; axis < 3 && size > 0; ++axis) clip(axis, h[axis]);
  }

  // A crossing is off by rounding as if the plane lay a few eps of the extent elsewhere, and along
  // the edge only. So the polygon lies within few eps of the exact one and contains what slabs that
  // are as much thinner leave of the triangle.
  void clip(int axis, double h) {
    cut(axis, 1, h);
    cut(axis, -1, h);
  }

  Vec middle() const {
    Vec sum = Vec::Zero();
    for (int i = 0; i < size; ++i) sum += corner[i];
    return sum / size;
  }

 private:
  void cut(int axis, double sign, double h) {
    bool inside = true;
    for (int i = 0; i < size; ++i) inside &= sign * corner[i][axis] <= h;
    if (inside) return;
    std::array<Vec, kMost> before;
    const int count = size;
    std::copy_n(corner.begin(), count, before.begin());
    size = 0;
    for (int i = 0; i < count; ++i) {
      const Vec &a = before[i], &b = before[(i + 1) % count];
      const double above_a = sign * a[axis] - h, above_b = sign * b[axis] - h;
      if (above_a <= 0 && size < kMost) corner[size++] = a;
      if (size < kMost && ((above_a < 0 && above_b > 0) || (above_a > 0 && above_b < 0))) {
        const double t = above_a / (above_a - above_b);
        corner[size] = a + t * (b - a);
        corner[size++][axis] = sign * h;
      }
    }
  }
};

}  // namespace kios::shape
