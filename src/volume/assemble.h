// SPDX-FileCopyrightText: 2026 The fcl_kios authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <algorithm>
#include <cmath>

#include "fcl_kios/volume.h"
#include "volume/balls.h"
#include "volume/lanes.h"
#include "volume/rounding.h"

namespace kios {

/// The cotangent of a cap's half opening angle over the rim of its content, 30 degrees: paper,
/// III-B.2; build/lane_fit.h draws it.
inline constexpr float kCot30 = 1.7320508F;

/// The exponent of the units in which a node of this radius stores its caps: 0 wherever floats and
/// their squares are far from under- and overflow, so that tests need no scaling.
inline int capExponent(double radius0) {
  const bool ordinary = radius0 == 0 || (radius0 >= 0x1p-30 && radius0 <= 0x1p30);
  return ordinary ? 0 : exponentOf(radius0);
}

/// Fills the caps beyond k with S0, sets the reach; center0, radius0, exponent and
/// the caps of k are set.
template <typename S>
void completeCaps(kIOS<S>& v, int k) {
  v.num_spheres = static_cast<std::uint8_t>(k);
  const float r0 = roundUpFloat(scaled(double{v.radius0}, -v.exponent));
  for (int i = k - 1; i < kIOS<S>::kCaps; ++i) {
    v.cap_x[i] = v.cap_y[i] = v.cap_z[i] = 0;
    v.cap_r[i] = r0;
  }
  // Sums of four floats: within 3 u of theirs.
  const lanes::Float4 reach = lanes::abs(lanes::load(v.cap_x)) + lanes::abs(lanes::load(v.cap_y)) +
                              lanes::abs(lanes::load(v.cap_z)) + lanes::load(v.cap_r);
  v.reach = std::max(lanes::horizontalMax(reach), r0) * (1 + 0x1p-20F);
}

}  // namespace kios
