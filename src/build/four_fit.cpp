// SPDX-FileCopyrightText: 2026 The fcl_kios authors
// SPDX-License-Identifier: BSD-3-Clause
#include "build/four_fit.h"

#include "build/four_axes.h"
#include "volume/assemble.h"

namespace kios {
namespace {

using lanes::broadcast;
using lanes::Float4;
using lanes::Int4;
using lanes::select;

constexpr float kRatio = 1.1F;  // as the tuned fit

/// Coordinates of the points along the axes, longest first, from the middle of the box.
struct InFrame {
  FourAxes axes;
  Float4 middle[3];  ///< of the box, in the frame of the points
  Float4 half[3];
  Float4 at[3][FourSets::kMost];
};

void orderPair(InFrame& f, int i, int j, Float4 (&from)[3]) {
  const Int4 swap = f.half[i] < f.half[j];
  const auto exchange = [swap](Float4& a, Float4& b) {
    const Float4 c = select(swap, b, a);
    b = select(swap, a, b);
    a = c;
  };
  exchange(f.half[i], f.half[j]);
  exchange(from[i], from[j]);
  for (int r = 0; r < 3; ++r) exchange(f.axes.column[i][r], f.axes.column[j][r]);
}

void project(const FourSets& s, InFrame& f) {
  const Float4 x0 = s.x[0], y0 = s.y[0], z0 = s.z[0];
  Scatter<Float4> m;
  Float4 n = broadcast(0);
  for (int i = 0; i < s.count; ++i) {
    const Float4 w = s.weight[i];
    m.add((s.x[i] - x0) * w, (s.y[i] - y0) * w, (s.z[i] - z0) * w);
    n += w;
  }
  m.center(1 / n);
  f.axes = principalAxes(m);
  Float4 low[3], high[3];
  for (int k = 0; k < 3; ++k) low[k] = high[k] = broadcast(0);
  for (int i = 1; i < s.count; ++i) {
    const Float4 x = s.x[i] - x0, y = s.y[i] - y0, z = s.z[i] - z0;
    for (int k = 0; k < 3; ++k) {
      const Float4(&e)[3] = f.axes.column[k];
      const Float4 h = x * e[0] + y * e[1] + z * e[2];
      low[k] = lanes::min(low[k], h);
      high[k] = lanes::max(high[k], h);
    }
  }
  Float4 from[3];
  for (int k = 0; k < 3; ++k) {
    from[k] = 0.5F * (low[k] + high[k]);
    f.half[k] = 0.5F * (high[k] - low[k]);
  }
  orderPair(f, 0, 1, from);
  orderPair(f, 1, 2, from);
  orderPair(f, 0, 1, from);
  for (int i = 0; i < s.count; ++i) {
    const Float4 x = s.x[i] - x0, y = s.y[i] - y0, z = s.z[i] - z0;
    for (int k = 0; k < 3; ++k) {
      const Float4(&e)[3] = f.axes.column[k];
      f.at[k][i] = x * e[0] + y * e[1] + z * e[2] - from[k];
    }
  }
  const Float4 first[3] = {x0, y0, z0};
  for (int r = 0; r < 3; ++r) {
    f.middle[r] = first[r];
    for (int k = 0; k < 3; ++k) f.middle[r] += from[k] * f.axes.column[k][r];
  }
}

/// Returns the u at which max(q - 2 u t) + u^2 over the points is about least: the coordinate of a
/// centre along an axis, where t are the points' coordinates along the axis and q their squared
/// distances from the centre at u = 0. The step follows the uppermost parabola from u = 0, then the
/// first one that it crosses.
Float4 lowestOn(const Float4* t, const Float4* q, int n) {
  constexpr int kSteps = 2;
  const Float4 zero = broadcast(0);
  Float4 top_q = q[0], top_t = t[0];
  for (int i = 1; i < n; ++i) {
    const Int4 higher = q[i] > top_q;
    top_q = lanes::max(q[i], top_q);
    top_t = select(higher, t[i], top_t);
  }
  const Float4 sign = select(top_t > zero, broadcast(1), broadcast(-1));
  Float4 reached = zero;  // along the sign
  for (int step = 0;; ++step) {
    Float4 stop = sign * top_t, next_t = top_t, next_q = top_q;
    for (int i = 0; i < n; ++i) {
      const Float4 slower = 2 * sign * (top_t - t[i]);
      const Float4 cross = (top_q - q[i]) / lanes::max(slower, broadcast(1e-30F));
      const Int4 first = (cross < stop) & (slower > zero);
      stop = select(first, cross, stop);
      next_t = select(first, t[i], next_t);
      next_q = select(first, q[i], next_q);
    }
    reached = lanes::max(reached, stop);
    if (step + 1 == kSteps) return sign * reached;
    // A parabola whose lowest point lies behind rises from here on.
    top_t = select(sign * next_t > reached, next_t, sign * reached);
    top_q = next_q;
  }
}

}  // namespace

FourSites placeFour(const FourSets& s, bool thorough) {
  InFrame f;
  project(s, f);
  const Float4 *const a = f.at[0], *const b = f.at[1], *const c = f.at[2];
  FourSites sites;
  for (int l = 0; l < 4; ++l) {
    const float longest = f.half[0][l];
    sites.k[l] = !(longest > kRatio * f.half[2][l]) ? 1 : (longest > kRatio * f.half[1][l] ? 5 : 3);
  }
  // Caps lie over the rim of the far side of the box, half opening angle 30 degrees.
  Float4 squares[FourSets::kMost], q[FourSets::kMost];  // q: relative to a centre, but for a shift
  Float4 rim_c = broadcast(0), rim_b = broadcast(0);
  for (int i = 0; i < s.count; ++i) {
    const Float4 aa = a[i] * a[i], bb = b[i] * b[i], cc = c[i] * c[i];
    rim_c = lanes::max(rim_c, aa + bb);
    rim_b = lanes::max(rim_b, aa + cc);
    squares[i] = aa + bb + cc;
  }
  const auto from = [&](const Float4* axis0, Float4 at0, const Float4* axis1, Float4 at1) {
    for (int i = 0; i < s.count; ++i) q[i] = squares[i] - 2 * (at0 * axis0[i] + at1 * axis1[i]);
  };
  const int rounds = thorough ? 2 : 1;
  const Float4 zero = broadcast(0);
  const Float4 height_c = lanes::max(zero, kCot30 * lanes::sqrt(rim_c) - f.half[2]);
  const Float4 height_b = lanes::max(zero, kCot30 * lanes::sqrt(rim_b) - f.half[1]);
  const Float4 hc[2] = {height_c, -height_c}, hb[2] = {height_b, -height_b};
  Float4 ua[2], ub[2], va[2];
  for (int side = 0; side < 2; ++side) {
    ub[side] = zero;
    for (int round = 0; round < rounds; ++round) {
      from(c, hc[side], b, ub[side]);
      ua[side] = lowestOn(a, q, s.count);
      from(c, hc[side], a, ua[side]);
      ub[side] = lowestOn(b, q, s.count);
    }
    from(b, hb[side], b, zero);
    va[side] = lowestOn(a, q, s.count);
  }
  Float4 sa = 0.5F * (ua[0] + ua[1]), sb = 0.5F * (ub[0] + ub[1]);
  if (thorough) {
    from(b, sb, b, zero);
    sa = lowestOn(a, q, s.count);
    from(a, sa, a, zero);
    sb = lowestOn(b, q, s.count);
  }
  const auto& e = f.axes.column;
  for (int r = 0; r < 3; ++r) {
    sites.center[r] = f.middle[r] + sa * e[0][r] + sb * e[1][r];
    for (int side = 0; side < 2; ++side) {
      sites.cap[side][r] =
          (ua[side] - sa) * e[0][r] + (ub[side] - sb) * e[1][r] + hc[side] * e[2][r];
      sites.cap[2 + side][r] = (va[side] - sa) * e[0][r] + (hb[side] - sb) * e[1][r];
    }
  }
  return sites;
}

// As fitTriangle() (triangle_fit.cpp), in floats.
FourSites placeFourTriangles(const FourSets& s) {
  using Vec = Float4[3];
  const auto dot = [](const Vec& a, const Vec& b) {
    return a[0] * b[0] + a[1] * b[1] + a[2] * b[2];
  };
  Vec p[3];
  for (int k = 0; k < 3; ++k) {
    p[k][0] = s.x[k] - s.x[0];
    p[k][1] = s.y[k] - s.y[0];
    p[k][2] = s.z[k] - s.z[0];
  }
  Float4 opposite[3];
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
  Vec apex, from, edge, middle;
  for (int r = 0; r < 3; ++r) {
    apex[r] = pick(p[0][r], p[1][r], p[2][r]);
    from[r] = pick(p[1][r], p[2][r], p[0][r]);
    const Float4 to = pick(p[2][r], p[0][r], p[1][r]);
    edge[r] = to - from[r];
    middle[r] = 0.5F * (from[r] + to);
  }
  const Float4 zero = broadcast(0), tiny = broadcast(1e-30F);
  const Float4 square = lanes::max(dot(edge, edge), tiny), length = lanes::sqrt(square);
  Vec to_apex, from_end, from_start;
  for (int r = 0; r < 3; ++r) {
    to_apex[r] = apex[r] - middle[r];
    from_start[r] = apex[r] - from[r];
    from_end[r] = from_start[r] - edge[r];
  }
  const Float4 along = dot(to_apex, edge), rise = dot(from_start, from_end);
  Vec across;
  for (int r = 0; r < 3; ++r) across[r] = select(along > zero, from_end[r], from_start[r]);
  const Float4 part = dot(across, edge) / square;
  for (int r = 0; r < 3; ++r) across[r] -= part * edge[r];
  const Float4 h = lanes::sqrt(dot(across, across));
  const Int4 thick = h > 1e-3F * length;
  Vec e0, e1, any, e2;
  for (int r = 0; r < 3; ++r) e0[r] = edge[r] / length;
  acrossAny(e0, any);
  const Float4 by_height = 1 / lanes::max(h, tiny);
  for (int r = 0; r < 3; ++r) e1[r] = select(thick, across[r] * by_height, any[r]);
  for (int r = 0; r < 3; ++r) {
    e2[r] = e0[(r + 1) % 3] * e1[(r + 2) % 3] - e0[(r + 2) % 3] * e1[(r + 1) % 3];
  }
  const Float4 a = 0.5F * length, x = along / length;
  const Float4 v0 = select((rise > zero) & (h > zero),
                           lanes::min(0.5774F * a, 0.5F * rise / lanes::max(h, tiny)), zero);
  const Float4 height = kCot30 * lanes::sqrt(a * a + v0 * v0);
  const Float4 first[3] = {s.x[0], s.y[0], s.z[0]};
  FourSites sites;
  for (int l = 0; l < 4; ++l) sites.k[l] = 5;
  for (int r = 0; r < 3; ++r) {
    sites.center[r] = first[r] + middle[r] + v0 * e1[r];
    sites.cap[0][r] = height * e2[r];
    sites.cap[1][r] = -sites.cap[0][r];
  }
  for (int side = 0; side < 2; ++side) {
    const Float4 from_box = kCot30 * a - 0.5F * h;
    const Float4 v = 0.5F * h + (side == 0 ? from_box : -from_box);
    const Float4 weight_edge = v * v, weight_apex = (h - v) * (h - v);
    const Int4 leans = x * x + weight_apex > a * a + weight_edge, right = x > zero;
    const Float4 end = select(right, -a, a), gap = x - end;
    const Float4 safe = select(lanes::abs(gap) > tiny, gap, tiny);
    Float4 u = 0.5F * (x * x - a * a + weight_apex - weight_edge) / safe;
    u = select(right, lanes::min(u, x), lanes::max(u, x));
    u = select(leans, u, zero);
    for (int r = 0; r < 3; ++r) sites.cap[2 + side][r] = u * e0[r] + (v - v0) * e1[r];
  }
  return sites;
}

FourSquares farthestSquares(const FourSets& s, const FourSites& sites) {
  FourSquares result;
  result.s0 = broadcast(0);
  for (Float4& c : result.cap) c = broadcast(0);
  for (int i = 0; i < s.count; ++i) {
    const Float4 x = s.x[i] - sites.center[0], y = s.y[i] - sites.center[1],
                 z = s.z[i] - sites.center[2];
    result.s0 = lanes::max(result.s0, x * x + y * y + z * z);
    for (int k = 0; k < 4; ++k) {
      const Float4 dx = x - sites.cap[k][0], dy = y - sites.cap[k][1], dz = z - sites.cap[k][2];
      result.cap[k] = lanes::max(result.cap[k], dx * dx + dy * dy + dz * dz);
    }
  }
  return result;
}

}  // namespace kios
