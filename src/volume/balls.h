// SPDX-FileCopyrightText: 2026 The fcl_kios authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <algorithm>
#include <array>
#include <cmath>

#include "fcl_kios/volume.h"

namespace kios {

/// A sphere of a kIOS in double, relative to some origin, in units of a power of two.
struct Ball {
  double x, y, z, r;
};

inline double norm(double x, double y, double z) { return std::sqrt(x * x + y * y + z * z); }

/// v 2^e, without a call where e is 0 as for all ordinary sizes.
inline double scaled(double v, int e) { return e == 0 ? v : std::ldexp(v, e); }

/// Returns the exponent of a length. That of NaN or infinity, which altered volumes may hold, can
/// be negated and added to others, too.
inline int exponentOf(double v) { return std::clamp(std::ilogb(v), -1100, 1100); }

/// The spheres of v in units of 2^exponent, S0's centre at `center` (in those units). Exact, but
/// for products below 2^-1022; the units are chosen so that this is negligible. Returns k.
template <typename S>
int toBalls(const kIOS<S>& v, const std::array<double, 3>& center, int exponent, Ball* out) {
  const double unit0 = scaled(1.0, -exponent / 2);  // in two steps: 2^-exponent may overflow
  const double unit1 = scaled(1.0, -exponent - (-exponent / 2));
  const double unit = scaled(1.0, v.exponent - exponent);
  out[0] = {center[0], center[1], center[2], double{v.radius0} * unit0 * unit1};
  for (int i = 1; i < v.k(); ++i) {
    out[i] = {center[0] + v.cap_x[i - 1] * unit, center[1] + v.cap_y[i - 1] * unit,
              center[2] + v.cap_z[i - 1] * unit, v.cap_r[i - 1] * unit};
  }
  return v.k();
}

}  // namespace kios
