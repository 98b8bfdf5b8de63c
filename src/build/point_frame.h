// SPDX-FileCopyrightText: 2026 The fcl_kios authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <algorithm>
#include <cmath>

#include <fcl/common/types.h>

namespace kios::engine {

/// The origin and the unit of points that are stored as floats q: p = origin + 2^exponent q.
struct PointFrame {
  double origin[3] = {};
  double to_frame = 1, to_model = 1;  ///< 2^-exponent, 2^exponent
  int exponent = 0;

  void setExponent(int e) {
    exponent = e;
    to_frame = std::ldexp(1.0, -e);
    to_model = std::ldexp(1.0, e);
  }

  /// Rounded once, to a float, but for the double difference.
  template <typename S>
  void place(const fcl::Vector3<S>& p, float (&q)[3]) const {
    for (int c = 0; c < 3; ++c) q[c] = static_cast<float>((p[c] - origin[c]) * to_frame);
  }
};

}  // namespace kios::engine
