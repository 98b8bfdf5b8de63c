// SPDX-FileCopyrightText: 2026 The fcl_kios authors
// SPDX-License-Identifier: BSD-3-Clause
#include "build/lane_fit.h"

#include "build/principal_frame.h"
#include "build/sphere_centers.h"

namespace kios {
using lanes::broadcast;
using lanes::Float4;

SphereSites placeTuned(const PointLanes& points, const float first[3], PointLanes& scratch) {
  PrincipalFrame frame = quickPrincipalFrame(points, scratch);
  const SphereCenters c = tunedCenters(scratch, frame, FitMethod::kTuned, 5);
  SphereSites sites;
  sites.k = c.k;
  const auto inModel = [&](float x, float y, float z, int row) {
    return frame.axes(row, 0) * x + frame.axes(row, 1) * y + frame.axes(row, 2) * z;
  };
  const float* const s0 = c.sphere[0];
  for (int r = 0; r < 3; ++r) {
    sites.center[r] = first[r] + inModel(frame.middle[0] + s0[0], frame.middle[1] + s0[1],
                                         frame.middle[2] + s0[2], r);
    for (int i = 1; i < c.k; ++i) {
      const float* const s = c.sphere[i];
      sites.cap[r][i - 1] = inModel(s[0] - s0[0], s[1] - s0[1], s[2] - s0[2], r);
    }
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

}  // namespace kios
