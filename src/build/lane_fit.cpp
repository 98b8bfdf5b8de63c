// SPDX-FileCopyrightText: 2026 The fcl_kios authors
// SPDX-License-Identifier: BSD-3-Clause
#include "build/lane_fit.h"

#include <algorithm>

#include "build/four_axes.h"
#include "build/tuning.h"
#include "volume/assemble.h"
#include "volume/rounding.h"

namespace kios {
namespace {

using lanes::broadcast;
using lanes::Float4;
using lanes::Int4;
using lanes::select;

/// The most of a set: of one set that of all lanes.
template <bool kOne>
Float4 mostOf(Float4 v) {
  return kOne ? broadcast(lanes::horizontalMax(v)) : v;
}

/// Coordinates of the points along the axes, longest first, from the middle of the box.
struct InFrame {
  int count;
  FourAxes axes;
  Float4 middle[3];  ///< of the box, in the frame of the points
  Float4 half[3];
  Float4 at[3][PointRows::kMost];
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

template <bool kOne>
void project(const PointRows& s, InFrame& f) {
  const PointQuad& p = s.points[0];
  const Float4 first[3] = {kOne ? broadcast(p.x[0]) : p.x, kOne ? broadcast(p.y[0]) : p.y,
                           kOne ? broadcast(p.z[0]) : p.z};
  f.count = s.count;
  Float4(&x)[PointRows::kMost] = f.at[0], (&y)[PointRows::kMost] = f.at[1],
  (&z)[PointRows::kMost] = f.at[2];
  Scatter<Float4> m;
  Float4 n = broadcast(0);
  for (int i = 0; i < s.count; ++i) {
    const Float4 w = s.weight[i];
    x[i] = s.points[i].x - first[0];
    y[i] = s.points[i].y - first[1];
    z[i] = s.points[i].z - first[2];
    m.add(x[i] * w, y[i] * w, z[i] * w);
    n += w;
  }
  if (kOne) {
    for (Float4* const v : {&m.x, &m.y, &m.z, &m.xx, &m.xy, &m.xz, &m.yy, &m.yz, &m.zz, &n}) {
      *v = broadcast(((*v)[0] + (*v)[1]) + ((*v)[2] + (*v)[3]));
    }
  }
  m.center(1 / n);
  f.axes = principalAxes(m);
  Float4 low[3], high[3], from[3];
  for (int k = 0; k < 3; ++k) low[k] = high[k] = broadcast(0);
  for (int i = 0; i < s.count; ++i) {
    for (int k = 0; k < 3; ++k) {
      const Float4(&e)[3] = f.axes.column[k];
      const Float4 h = x[i] * e[0] + y[i] * e[1] + z[i] * e[2];
      low[k] = lanes::min(low[k], h);
      high[k] = lanes::max(high[k], h);
    }
  }
  for (int k = 0; k < 3; ++k) {
    const Float4 lowest = -mostOf<kOne>(-low[k]), highest = mostOf<kOne>(high[k]);
    from[k] = 0.5F * (lowest + highest);
    f.half[k] = 0.5F * (highest - lowest);
  }
  orderPair(f, 0, 1, from);
  orderPair(f, 1, 2, from);
  orderPair(f, 0, 1, from);
  const auto& e = f.axes.column;
  for (int i = 0; i < s.count; ++i) {
    const Float4 px = x[i], py = y[i], pz = z[i];
    for (int k = 0; k < 3; ++k) {
      f.at[k][i] = px * e[k][0] + py * e[k][1] + pz * e[k][2] - from[k];
    }
  }
  for (int r = 0; r < 3; ++r) {
    f.middle[r] = first[r];
    for (int k = 0; k < 3; ++k) f.middle[r] += from[k] * e[k][r];
  }
}

/// A point in the frame.
struct Held {
  Float4 at[3];

  void set(Int4 where, const Held& p) {
    for (int k = 0; k < 3; ++k) at[k] = select(where, p.at[k], at[k]);
  }
  /// Makes all lanes that of the greatest key.
  void agree(Float4 key) {
    int best = 0;
    for (int lane = 1; lane < 4; ++lane) {
      if (key[lane] > key[best]) best = lane;
    }
    for (Float4& v : at) v = broadcast(v[best]);
  }
};

Float4 squaredDistance(const Held& a, const Float4 (&b)[3]) {
  const Float4 x = a.at[0] - b[0], y = a.at[1] - b[1], z = a.at[2] - b[2];
  return x * x + y * y + z * z;
}

/// Moves a centre in the plane across an axis, or anywhere if that is 3, towards where the farthest
/// point is nearest, to 1 % of its distance. Two points hold it, those of `held` at first: it moves
/// towards the place that is best for the two, until another point is as far, which then takes the
/// place of the nearer one. If that doesn't let it go, it moves across the triangle of the three.
/// No step ends where the farthest point is farther than before.
template <bool kOne, int kAcross>
void recenter(const InFrame& f, int steps, Held (&held)[2], Float4 (&center)[3]) {
  const Float4 zero = broadcast(0), one = broadcast(1), tiny = broadcast(1e-30F);
  const auto point = [&f](int i) { return Held{{f.at[0][i], f.at[1][i], f.at[2][i]}}; };
  Held far = point(0);
  Float4 top = squaredDistance(far, center);
  for (int i = 1; i < f.count; ++i) {
    const Held p = point(i);
    const Float4 square = squaredDistance(p, center);
    far.set(square > top, p);
    top = lanes::max(square, top);
  }
  if (kOne) far.agree(top);
  top = mostOf<kOne>(top);
  Held &a = held[0], &b = held[1];
  Float4 of_a = squaredDistance(a, center), of_b = squaredDistance(b, center);
  const Int4 stale = lanes::max(of_a, of_b) < 0.999F * top;
  b.set(stale & (of_a > of_b), a);
  a.set(stale, far);
  Held third = a;
  bool blocked = false;
  for (int step = 0; step < steps; ++step) {
    of_a = squaredDistance(a, center);
    of_b = squaredDistance(b, center);
    Held lead = a;
    lead.set(of_b > of_a, b);
    // The best place for a and b lies between them.
    Float4 between[3], square = zero, out_a = zero, out_b = zero;
    for (int k = 0; k < 3; ++k) {
      between[k] = k == kAcross ? zero : b.at[k] - a.at[k];
      square += between[k] * between[k];
      if (k != kAcross) continue;
      const Float4 at_a = a.at[k] - center[k], at_b = b.at[k] - center[k];
      out_a = at_a * at_a;
      out_b = at_b * at_b;
    }
    const Float4 part =
        lanes::min(lanes::max(0.5F + 0.5F * (out_b - out_a) / lanes::max(square, tiny), zero), one);
    const Float4 bound =
        lanes::max(part * part * square + out_a, (1 - part) * (1 - part) * square + out_b);
    const Float4 reached = lanes::max(of_a, of_b);
    const Int4 open = reached > tuning::kCentred * bound;
    if (!lanes::any(open)) return;
    Float4 d[3], height = zero;
    for (int k = 0; k < 3; ++k) {
      d[k] = k == kAcross ? zero : a.at[k] + part * between[k] - center[k];
    }
    if (blocked) {
      const Float4 by_length = 1 / lanes::sqrt(lanes::max(square, tiny));
      Float4 n[3], along = zero, of_n = tiny;
      for (int k = 0; k < 3; ++k) {
        const int i = (k + 1) % 3, j = (k + 2) % 3;
        n[k] = by_length *
               (between[i] * (third.at[j] - a.at[j]) - between[j] * (third.at[i] - a.at[i]));
        along += n[k] * (a.at[k] - center[k]);
        of_n += n[k] * n[k];
      }
      const Float4 by_n = 1 / lanes::sqrt(of_n), off = along * by_n;
      if (!(off[0] * off[0] > 0.01F * reached[0])) return;
      for (int k = 0; k < 3; ++k) d[k] = off * by_n * n[k];
    }
    for (int k = 0; k < 3; ++k) height += d[k] * lead.at[k];
    const Float4 least = 1e-4F * reached + tiny;  // what is slower by less than that isn't met
    Float4 stop = select(open, one, zero);
    Held hit = b;
    for (int i = 0; i < f.count; ++i) {
      const Held p = point(i);
      Float4 slower = height;
      for (int k = 0; k < 3; ++k) {
        if (k != kAcross) slower -= d[k] * p.at[k];
      }
      slower *= 2;
      const Float4 cross = (reached - squaredDistance(p, center)) / lanes::max(slower, least);
      const Int4 first = (cross < stop) & (slower > least);
      stop = select(first, cross, stop);
      hit.set(first, p);
    }
    if (kOne) {
      hit.agree(-stop);
      stop = -mostOf<kOne>(-stop);
      const bool stuck =
          stop[0] < 1e-3F && square[0] > 0 && std::min(of_a[0], of_b[0]) > 0.999F * reached[0];
      if (kAcross != 3 && stuck) return;
      blocked = stuck && !blocked;
    }
    const Int4 met = open & (stop < one);
    stop = lanes::max(stop, zero);
    for (int k = 0; k < 3; ++k) center[k] += stop * d[k];
    third = a;
    third.set(of_a >= of_b, b);
    b.set(met, lead);
    a.set(met, hit);
  }
}

template <bool kOne>
SphereSites place(const PointRows& rows, int steps) {
  using tuning::kRatio;
  InFrame f;
  project<kOne>(rows, f);
  SphereSites sites;
  for (int l = 0; l < 4; ++l) {
    const float longest = f.half[0][l];
    sites.k[l] = !(longest > kRatio * f.half[2][l]) ? 1 : (longest > kRatio * f.half[1][l] ? 5 : 3);
  }
  const Float4 zero = broadcast(0);
  Float4 s0[3] = {zero, zero, zero}, cap[4][3];
  Held first = {{f.at[0][0], f.at[1][0], f.at[2][0]}};
  if (kOne) first.agree(zero);
  Held held[2] = {first, first};
  const bool thick = kOne && f.half[2][0] > tuning::kThick * f.half[0][0];
  thick ? recenter<kOne, 3>(f, steps, held, s0) : recenter<kOne, 2>(f, steps, held, s0);
  Float4 rim[2] = {zero, zero};
  for (int i = 0; i < f.count; ++i) {
    const Float4 a = f.at[0][i], b = f.at[1][i], c = f.at[2][i];
    rim[0] = lanes::max(rim[0], a * a + b * b);
    rim[1] = lanes::max(rim[1], a * a + c * c);
  }
  for (int pair = 0; pair < 2; ++pair) {
    const int axis = 2 - pair;
    const Float4 height =
        lanes::max(zero, kCot30 * lanes::sqrt(mostOf<kOne>(rim[pair])) - f.half[axis]);
    for (int side = 0; side < 2; ++side) {
      Float4(&at)[3] = cap[2 * pair + side];
      std::copy_n(s0, 3, at);
      at[axis] = side == 0 ? height : -height;
      pair == 0 ? recenter<kOne, 2>(f, steps, held, at) : recenter<kOne, 1>(f, steps, held, at);
    }
  }
  const auto& e = f.axes.column;
  for (int r = 0; r < 3; ++r) {
    sites.center[r] = f.middle[r] + s0[0] * e[0][r] + s0[1] * e[1][r] + s0[2] * e[2][r];
    for (int i = 0; i < 4; ++i) {
      sites.cap[i][r] = (cap[i][0] - s0[0]) * e[0][r] + (cap[i][1] - s0[1]) * e[1][r] +
                        (cap[i][2] - s0[2]) * e[2][r];
    }
  }
  return sites;
}

}  // namespace

SphereSites placeSpheres(const PointRows& rows, Sets sets) {
  const int steps = tuning::kSteps[static_cast<int>(sets)];
  return sets == Sets::kOne ? place<true>(rows, steps) : place<false>(rows, steps);
}

FarthestSquares farthestSquares(const PointQuad* rows, std::size_t n, const SphereSites& sites) {
  FarthestSquares result;
  result.s0 = broadcast(0);
  for (Float4& c : result.cap) c = broadcast(0);
  for (std::size_t i = 0; i < n; ++i) {
    const Float4 x = rows[i].x - sites.center[0], y = rows[i].y - sites.center[1],
                 z = rows[i].z - sites.center[2];
    result.s0 = lanes::max(result.s0, x * x + y * y + z * z);
    for (int k = 0; k < 4; ++k) {
      const Float4 dx = x - sites.cap[k][0], dy = y - sites.cap[k][1], dz = z - sites.cap[k][2];
      result.cap[k] = lanes::max(result.cap[k], dx * dx + dy * dy + dz * dz);
    }
  }
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
    const auto x = roundedTo<float>(of_x), y = roundedTo<float>(of_y), z = roundedTo<float>(of_z);
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

PointRows rowsOf(const Extremes* parts, int n) {
  PointRows rows;
  int count = 0;
  for (const Extremes* e = parts; e < parts + n; ++e) {
    for (int i = 0; i < e->count; ++i, ++count) {
      rows.set(count / 4, count % 4, e->x[i], e->y[i], e->z[i], 1);
    }
  }
  for (; count % 4 != 0; ++count) {
    rows.set(count / 4, count % 4, parts->x[0], parts->y[0], parts->z[0], 0);
  }
  rows.count = count / 4;
  return rows;
}

}  // namespace kios
