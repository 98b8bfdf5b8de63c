// SPDX-FileCopyrightText: 2026 The fcl_kios authors
// SPDX-License-Identifier: BSD-3-Clause
#include "scene/body.h"

#include <cmath>

namespace kios::scene {

void setPose(Body& body, const fcl::Transform3d& X_W, double rotation_square) {
  body.X_W = X_W;
  body.rotation_square = rotation_square;
  // A power of two, so that it stays the same while rounding errors come and go.
  body.rotation_error = std::ldexp(1.0, std::ilogb(std::sqrt(rotation_square) + 0x1p-48) + 1);
}

// A sphere of the world is around X c. R stretches by at most 1 + |E|. The distance that the narrow
// phase computes, in the first body's frame, differs from the distance d in the world by at most:
// |E| (d + reach) from a frame that isn't orthonormal; the triangles' error, of an extent of at
// most 1.74 (d + 2 r + 2 r'); the common frame's, for |x'|_1 <= 2 reach' and |T|_1 <= 1.74 |t' -
// t|, which is at most 1.74 (d + reach + reach'). The terms in d are boxShare()'s, the rest is
// split over the boxes, with what rounding to float may take off an answer near 0.
void setBox(Body& body) {
  Box& box = body.box;
  box = {{-kInfinity, -kInfinity, -kInfinity}, {kInfinity, kInfinity, kInfinity}};
  const Sphere& sphere = body.sphere;
  if (!(sphere.radius < kInfinity)) return;
  const double error = body.rotation_error;
  const double pads =
      2 * error * body.reach +
      error_bounds::triangleError<double>(error_bounds::extentOf(0, sphere.radius, 0)) +
      error_bounds::frameError<double>(2 * body.reach, 1.74 * body.reach);
  for (int i = 0; i < 3; ++i) {
    double at = body.X_W.translation()[i], terms = std::abs(at);
    for (int j = 0; j < 3; ++j) {
      const double term = body.X_W.linear()(i, j) * sphere.center[j];
      at += term;
      terms += std::abs(term);
    }
    const double r =
        (sphere.radius * (1 + error) + pads + error_bounds::sumError<double>(terms) + kLeastFloat) *
        (1 + 0x1p-50);
    box.lower[i] = at - r;
    box.upper[i] = at + r;
  }
}

}  // namespace kios::scene
