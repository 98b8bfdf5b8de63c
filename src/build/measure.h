// SPDX-FileCopyrightText: 2026 The fcl_kios authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <algorithm>
#include <cmath>
#include <limits>

#include "fcl_kios/volume.h"
#include "volume/assemble.h"
#include "volume/balls.h"
#include "volume/errors.h"
#include "volume/lanes.h"
#include "volume/rounding.h"

namespace kios {

/// Throws for the first point that can't be bounded.
template <typename S>
void requireUsable(const fcl::Vector3<S>* points, int n) {
  for (int i = 0; i < n; ++i) {
    const fcl::Vector3<S>& p = points[i];
    bool usable = true;
    for (int c = 0; c < 3; ++c) usable &= std::abs(double{p[c]}) <= kMaxCoordinate<S>;
    if (usable) continue;
    refuse("vertex (", p[0], ", ", p[1], ", ", p[2], ") is not finite or above ", kMaxCoordinate<S>,
           " in magnitude; the model stays unfinished.");
  }
}

/// Completes a volume of k spheres around points, of one where the points are one. Its center0 is
/// set, and its caps' centres in units of 2^exponent; the points lie within a few such units of
/// center0.
///
/// Radii are measured from the centres as stored. S0: q = p - c has a relative error of u a
/// coordinate, the root of its squares 3.5 u, so (1 + 8 u) covers it. A cap: q in float is off by
/// u |q| <= u r0 (u = 2^-24), the distance and what is added by another 6 u of themselves: (1 + 16
/// u) and 4 u r0.
template <typename S>
inline void measure(const fcl::Vector3<S>* points, int n, int exponent, int k, kIOS<S>& bv) {
  using lanes::Float4;
  const double cx = bv.center0[0], cy = bv.center0[1], cz = bv.center0[2];
  const double unit0 = scaled(1.0, -exponent / 2);  // two steps: one may overflow
  const double unit1 = scaled(1.0, -exponent - (-exponent / 2));
  const Float4 ox = lanes::load(bv.cap_x), oy = lanes::load(bv.cap_y), oz = lanes::load(bv.cap_z);
  double r0_squared = 0;
  Float4 cap_squared = lanes::broadcast(0.0F);
  for (int i = 0; i < n; ++i) {
    const double qx = (points[i][0] - cx) * unit0 * unit1;
    const double qy = (points[i][1] - cy) * unit0 * unit1;
    const double qz = (points[i][2] - cz) * unit0 * unit1;
    r0_squared = std::max(r0_squared, qx * qx + qy * qy + qz * qz);
    const Float4 dx = ox - roundedTo<float>(qx), dy = oy - roundedTo<float>(qy),
                 dz = oz - roundedTo<float>(qz);
    cap_squared = lanes::max(cap_squared, dx * dx + dy * dy + dz * dz);
  }
  const double r0 = std::sqrt(r0_squared) * (1 + 8 * kUlpDouble);
  bv.radius0 = roundUp<S>(scaled(r0, exponent));
  if (exponent < -500) {  // a subnormal radius may have been rounded down
    bv.radius0 = std::nextafter(bv.radius0, std::numeric_limits<S>::infinity());
  }
  const float pad = roundedTo<float>(r0) * 0x1p-22F + 0x1p-120F;
  const Float4 cap_r = lanes::sqrt(cap_squared) * (1 + 0x1p-20F) + pad;
  bv.exponent = static_cast<std::int16_t>(capExponent(bv.radius0));
  const auto to_cap_units = roundedTo<float>(scaled(1.0, exponent - bv.exponent));
  lanes::store(bv.cap_x, ox * to_cap_units);
  lanes::store(bv.cap_y, oy * to_cap_units);
  lanes::store(bv.cap_z, oz * to_cap_units);
  lanes::store(bv.cap_r, cap_r * to_cap_units);
  completeCaps(bv, r0_squared > 0 ? k : 1);
}

}  // namespace kios
