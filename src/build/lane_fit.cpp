// SPDX-FileCopyrightText: 2026 The fcl_kios authors
// SPDX-License-Identifier: BSD-3-Clause
#include "build/lane_fit.h"

#include <algorithm>

#include "build/principal_frame.h"
#include "build/sphere_centers.h"

namespace kios {
using lanes::broadcast;
using lanes::Float4;
using lanes::Int4;

SphereSites placeTuned(const PointLanes& points, const float first[3], PointLanes& scratch) {
  const PrincipalFrame frame = quickPrincipalFrame(points, scratch);
  const SphereCenters c = inAxesOfPoints(tunedCenters(scratch, frame, FitMethod::kTuned, 5), frame);
  SphereSites sites;
  sites.k = c.k;
  for (int r = 0; r < 3; ++r) {
    sites.center[r] = first[r] + c.sphere[0][r];
    for (int i = 1; i < c.k; ++i) sites.cap[r][i - 1] = c.sphere[i][r];
  }
  return sites;
}

FarthestSquares farthestSquares(const PointQuad* quads, std::size_t n, const SphereSites& sites) {
  const float cx = sites.center[0], cy = sites.center[1], cz = sites.center[2];
  Float4 squares[5];
  for (Float4& s : squares) s = broadcast(0);
  for (std::size_t i = 0; i < n; ++i) {
    const Float4 x = quads[i].x, y = quads[i].y, z = quads[i].z;
    const Float4 dx = x - cx, dy = y - cy, dz = z - cz;
    squares[0] = lanes::max(squares[0], dx * dx + dy * dy + dz * dz);
    for (int s = 0; s < 4; ++s) {
      const Float4 ex = dx - sites.cap[0][s], ey = dy - sites.cap[1][s], ez = dz - sites.cap[2][s];
      squares[s + 1] = lanes::max(squares[s + 1], ex * ex + ey * ey + ez * ez);
    }
  }
  FarthestSquares result;
  result.s0 = lanes::horizontalMax(squares[0]);
  for (int s = 0; s < 4; ++s) result.cap[s] = lanes::horizontalMax(squares[s + 1]);
  return result;
}

void Extremes::move(Float4 by) {
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

}  // namespace kios
