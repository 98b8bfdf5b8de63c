// SPDX-FileCopyrightText: 2026 The fcl_kios authors
// SPDX-License-Identifier: BSD-3-Clause
#include "build/four_axes.h"
#include "build/lane_fit.h"
#include "volume/assemble.h"

namespace kios {

using lanes::broadcast;
using lanes::Float4;
using lanes::Int4;
using lanes::select;

/// Longest edge from (-a, 0) to (a, 0), apex at (x, h), |x| <= a: S0 at (0, v0), its caps along the
/// normal at the same place, those across the longest edge at (u, v).
SphereSites placeTriangles(const PointRows& t) {
  using Vec = Float4[3];
  const auto dot = [](const Vec& a, const Vec& b) {
    return a[0] * b[0] + a[1] * b[1] + a[2] * b[2];
  };
  Vec p[3];
  for (int k = 0; k < 3; ++k) {
    p[k][0] = t.points[k].x - t.points[0].x;
    p[k][1] = t.points[k].y - t.points[0].y;
    p[k][2] = t.points[k].z - t.points[0].z;
  }
  Vec opposite;
  for (int k = 0; k < 3; ++k) {
    Vec e;
    for (int r = 0; r < 3; ++r) e[r] = p[(k + 2) % 3][r] - p[(k + 1) % 3][r];
    opposite[k] = dot(e, e);
  }
  const Int4 second = opposite[1] > opposite[0];
  const Int4 third = opposite[2] > lanes::max(opposite[0], opposite[1]);
  const auto pick = [&](Float4 zeroth, Float4 one, Float4 two) {
    return select(third, two, select(second, one, zeroth));
  };
  Vec apex, from, to, edge, middle;
  for (int r = 0; r < 3; ++r) {
    apex[r] = pick(p[0][r], p[1][r], p[2][r]);
    from[r] = pick(p[1][r], p[2][r], p[0][r]);
    to[r] = pick(p[2][r], p[0][r], p[1][r]);
    edge[r] = to[r] - from[r];
    middle[r] = 0.5F * (from[r] + to[r]);
  }
  const Float4 zero = broadcast(0), tiny = broadcast(1e-30F);
  const Float4 square = lanes::max(dot(edge, edge), tiny), length = lanes::sqrt(square);
  Vec to_apex, from_end, from_start;
  for (int r = 0; r < 3; ++r) {
    to_apex[r] = apex[r] - middle[r];
    from_start[r] = apex[r] - from[r];
    from_end[r] = apex[r] - to[r];
  }
  // A small height is measured from the nearer end: for slivers, rounding would swallow it if it
  // were measured from the middle.
  const Float4 along = dot(to_apex, edge), rise = dot(from_start, from_end);
  Vec across;
  for (int r = 0; r < 3; ++r) across[r] = select(along > zero, from_end[r], from_start[r]);
  const Float4 part = dot(across, edge) / square;
  for (int r = 0; r < 3; ++r) across[r] -= part * edge[r];
  const Float4 h = lanes::sqrt(dot(across, across));
  const Int4 thick = h > 1e-3F * length;
  Vec e0, any, e1, e2;
  for (int r = 0; r < 3; ++r) e0[r] = edge[r] / length;
  acrossAny(e0, any);
  const Float4 by_height = 1 / lanes::max(h, tiny);
  for (int r = 0; r < 3; ++r) e1[r] = select(thick, across[r] * by_height, any[r]);
  for (int r = 0; r < 3; ++r) {
    e2[r] = e0[(r + 1) % 3] * e1[(r + 2) % 3] - e0[(r + 2) % 3] * e1[(r + 1) % 3];
  }
  // Acute if the apex lies outside the ball over the longest edge: then the circumcentre, which is
  // at most h / 2 above that edge, is the minimal circle's.
  const Float4 a = 0.5F * length, x = along / length;
  const Float4 v0 = select(rise > zero, lanes::min(0.5F * h, 0.5F * rise * by_height), zero);
  const Float4 height = kCot30 * lanes::sqrt(a * a + v0 * v0);
  const Float4 first[3] = {t.points[0].x, t.points[0].y, t.points[0].z};
  SphereSites sites;
  for (int& k : sites.k) k = 5;
  for (int r = 0; r < 3; ++r) {
    sites.center[r] = first[r] + middle[r] + v0 * e1[r];
    sites.cap[0][r] = height * e2[r];
    sites.cap[1][r] = -sites.cap[0][r];
  }
  for (int side = 0; side < 2; ++side) {
    const Float4 from_box = kCot30 * a - 0.5F * h;
    const Float4 v = 0.5F * h + (side == 0 ? from_box : -from_box);
    // Along the edge: its middle, unless the apex is farther; then level with the far end.
    const Float4 weight_edge = v * v, weight_apex = (h - v) * (h - v);
    const Int4 leans = x * x + weight_apex > a * a + weight_edge, right = x > zero;
    const Float4 gap = select(right, lanes::max(x + a, tiny), lanes::min(x - a, -tiny));
    Float4 u = 0.5F * (x * x - a * a + weight_apex - weight_edge) / gap;
    u = select(right, lanes::min(u, x), lanes::max(u, x));
    u = select(leans, u, zero);
    for (int r = 0; r < 3; ++r) sites.cap[2 + side][r] = u * e0[r] + (v - v0) * e1[r];
  }
  return sites;
}

}  // namespace kios
