// SPDX-FileCopyrightText: 2026 The fcl_kios authors
// SPDX-License-Identifier: BSD-3-Clause
#include "build/extremes.h"

#include <algorithm>

namespace kios::engine {

using lanes::Float4;
using lanes::Int4;

void Extremes::move(const float (&by)[3]) {
  for (int i = 0; i < count; ++i) {
    x[i] += by[0];
    y[i] += by[1];
    z[i] += by[2];
  }
}

Extremes extremesOf(const PointQuad* quads, std::size_t n) {
  Extremes e;
  int taken[Extremes::kMost];
  const auto take = [&](int index) {
    if (std::find(taken, taken + e.count, index) != taken + e.count) return;
    const PointQuad& q = quads[index / 4];
    taken[e.count] = index;
    e.x[e.count] = q.x[index % 4];
    e.y[e.count] = q.y[index % 4];
    e.z[e.count++] = q.z[index % 4];
  };
  for (int direction = 0; direction < Extremes::kDirections; ++direction) {
    const int of_x = direction % 3 - 1, of_y = direction / 3 % 3 - 1, of_z = direction / 9 - 1;
    const auto x = static_cast<float>(of_x), y = static_cast<float>(of_y),
               z = static_cast<float>(of_z);
    Float4 low = quads[0].x * x + quads[0].y * y + quads[0].z * z, high = low;
    Int4 at = {0, 1, 2, 3}, low_at = at, high_at = at;
    for (std::size_t i = 1; i < n; ++i) {
      at += 4;
      const Float4 h = quads[i].x * x + quads[i].y * y + quads[i].z * z;
      const Int4 lower = h<low, higher = h> high;
      low_at = (lower & at) | (~lower & low_at);
      high_at = (higher & at) | (~higher & high_at);
      low = lanes::min(low, h);
      high = lanes::max(high, h);
    }
    int least = 0, most = 0;
    for (int lane = 1; lane < 4; ++lane) {
      if (low[lane] < low[least]) least = lane;
      if (high[lane] > high[most]) most = lane;
    }
    take(low_at[least]);
    take(high_at[most]);
  }
  return e;
}

}  // namespace kios::engine
