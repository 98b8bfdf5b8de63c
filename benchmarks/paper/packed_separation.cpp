// SPDX-FileCopyrightText: 2026 The fcl_kios authors
// SPDX-License-Identifier: BSD-3-Clause
#include <algorithm>
#include <cmath>
#include <limits>

#include "paper/visit_caps.h"
#include "volume/balls.h"
#include "volume/lanes.h"
#include "volume/rounding.h"

namespace kios::paper {
namespace {

constexpr double kInfinity = std::numeric_limits<double>::infinity();

/// Caps in float lanes, whole groups of four: those that are missing repeat S0. Units are scaled.
struct LaneCaps {
  float x[CapSpheres::kMostCaps], y[CapSpheres::kMostCaps], z[CapSpheres::kMostCaps],
      r[CapSpheres::kMostCaps];
  int caps = 0;
  float reach = 0;  ///< >= |offset| + radius of every sphere

  void set(int i, float ox, float oy, float oz, float radius) {
    x[i] = ox;
    y[i] = oy;
    z[i] = oz;
    r[i] = radius;
    reach = std::max(reach, std::abs(ox) + std::abs(oy) + std::abs(oz) + radius);
  }
  void complete(float radius0) {
    for (int i = caps; i < ((caps + 3) & ~3); ++i) set(i, 0, 0, 0, radius0);
    reach = std::max(reach, radius0) * (1 + 0x1p-20F);  // sums of four floats: within 3 u
  }
};

}  // namespace

// Everything is in units of 2^e, in which the larger model's points have coordinates of at most 1
// (or e is so large that a translation is below 2^402, whose square is finite). With u = 2^-53 and
// m = |R o_b| + |T| + |o_a| + coordinates, as sums of magnitudes: T' = R o_b + T - o_a takes 7
// roundings a coordinate, R c_b + T' - c_a another 6, the leaf's R y + T 5, root and sums of the
// bound 8 of values <= 2 m. That is below 34 u m; 2^-47 is 64 u. Where doubles are subnormal each
// rounding is 2^-1074 absolute, and what float units lose by underflow is below 2^-120.
PackedPolicy::Placed PackedPolicy::place(const Shared& a, const Shared& b,
                                         const RelativePose<double>& X_AB) const {
  Placed X;
  X.a = &a;
  X.b = &b;
  const double magnitude =
      1.8 * b.origin.lpNorm<1>() + detail::boundsOf(X_AB).T_norm1 + a.origin.lpNorm<1>();
  int e = std::max(a.exponent, b.exponent);
  if (magnitude > 0) e = std::max(e, std::ilogb(magnitude) - 400);
  for (int i = 0; i < 3; ++i) {
    const double moved = X_AB.R()(i, 0) * b.origin[0] + X_AB.R()(i, 1) * b.origin[1] +
                         X_AB.R()(i, 2) * b.origin[2] + X_AB.T()[i] - a.origin[i];
    X.T[i] = scaled(moved, -e);
    for (int j = 0; j < 3; ++j) {
      X.R[i][j] = X_AB.R()(i, j);
      X.Rf[i][j] = detail::boundsOf(X_AB).R[i][j];
    }
  }
  X.unit_a = scaled(1.0, a.exponent - e);
  X.unit_b = scaled(1.0, b.exponent - e);
  // 3 coordinates and radii of at most 4 units each, and R.
  const double m = scaled(magnitude, -e) + 16 * (X.unit_a + X.unit_b);
  X.pad = 0x1p-47 * m + scaled(0x1p-1066, -e) + 0x1p-118;
  X.stretch = detail::boundsOf(X_AB).stretch;
  X.length = scaled(1.0, e);
  return X;
}

double PackedPolicy::separation(PackedStore::Packed pa, PackedStore::Packed pb, const Placed& X,
                                double enough) const {
  using lanes::Float4;
  if (!pa.data || !pb.data) return kInfinity;
  const double ra = pa.data[3] * X.unit_a, rb = pb.data[3] * X.unit_b;
  const double bx = pb.data[0] * X.unit_b, by = pb.data[1] * X.unit_b, bz = pb.data[2] * X.unit_b;
  const double dx = X.R[0][0] * bx + X.R[0][1] * by + X.R[0][2] * bz + X.T[0] -
                    pa.data[0] * X.unit_a,
               dy = X.R[1][0] * bx + X.R[1][1] * by + X.R[1][2] * bz + X.T[1] -
                    pa.data[1] * X.unit_a,
               dz = X.R[2][0] * bx + X.R[2][1] * by + X.R[2][2] * bz + X.T[2] -
                    pa.data[2] * X.unit_a;
  const double distance = norm(dx, dy, dz);
  const double central = distance - ra - rb - (X.pad + X.stretch * rb);
  constexpr double kFar = 0x1p40;
  if ((pa.pairs | pb.pairs) == 0 || central * X.length > enough || !(distance < kFar)) {
    return central * X.length;
  }

  // All other pairs in float lanes, centres relative to a's S0. Each lane has at most 16 u of
  // error, u = 2^-24, of |D| and the reaches, as src/volume/separation.cpp counts; 2^-19 is 32 u.
  LaneCaps a, b;
  const auto decode = [this](PackedStore::Packed v, const Shared& model, double unit, LaneCaps& s) {
    const auto u = static_cast<float>(unit);
    visitCaps(v, model, [&s, u](int i, float /*height*/, float x, float y, float z, float r) {
      s.set(i, x * u, y * u, z * u, r * u);
      s.caps = i + 1;
    });
    s.complete(v.data[3] * u);
  };
  decode(pa, *X.a, X.unit_a, a);
  decode(pb, *X.b, X.unit_b, b);
  const auto fx = static_cast<float>(dx), fy = static_cast<float>(dy), fz = static_cast<float>(dz);
  const auto ra0 = static_cast<float>(ra), rb0 = static_cast<float>(rb);
  Float4 best = lanes::broadcast(-std::numeric_limits<float>::infinity());
  for (int i = 0; i < a.caps; i += 4) {
    const Float4 x = fx - lanes::load(a.x + i), y = fy - lanes::load(a.y + i),
                 z = fz - lanes::load(a.z + i);
    best = lanes::max(best, lanes::sqrt(x * x + y * y + z * z) - lanes::load(a.r + i) - rb0);
  }
  for (int j = 0; j < b.caps; j += 4) {
    const Float4 ox = lanes::load(b.x + j), oy = lanes::load(b.y + j), oz = lanes::load(b.z + j);
    const Float4 r = lanes::load(b.r + j);
    const Float4 x = X.Rf[0][0] * ox + X.Rf[0][1] * oy + X.Rf[0][2] * oz + fx;
    const Float4 y = X.Rf[1][0] * ox + X.Rf[1][1] * oy + X.Rf[1][2] * oz + fy;
    const Float4 z = X.Rf[2][0] * ox + X.Rf[2][1] * oy + X.Rf[2][2] * oz + fz;
    best = lanes::max(best, lanes::sqrt(x * x + y * y + z * z) - r - ra0);
    for (int i = 0; i < a.caps; ++i) {
      const Float4 wx = x - a.x[i], wy = y - a.y[i], wz = z - a.z[i];
      best = lanes::max(best, lanes::sqrt(wx * wx + wy * wy + wz * wz) - r - a.r[i]);
    }
  }
  const double lengths = distance * 1.8 + a.reach + b.reach;
  const double caps =
      lanes::horizontalMax(best) - (0x1p-19 * lengths + X.stretch * b.reach + X.pad);
  return std::max(central, caps) * X.length;
}

bool PackedPolicy::contains(PackedStore::Packed v, const Shared& model,
                            const fcl::Vector3d& p) const {
  if (!v.data || !p.allFinite()) return false;
  const CapSpheres s = unpack(v, model);
  const double unit = scaled(1.0, -model.exponent);
  const fcl::Vector3d q = (p - model.origin) * unit;
  const fcl::Vector3d c(s.center[0], s.center[1], s.center[2]);
  // As in the fit: a point of the content is within the radius but for these roundings.
  const auto outside = [&](const fcl::Vector3d& o, double r) {
    const double pad = 8 * kUlpDouble * (q.lpNorm<1>() + c.lpNorm<1>() + o.lpNorm<1>());
    return (q - c - o).norm() * (1 - 8 * kUlpDouble) - pad > r;
  };
  if (outside(fcl::Vector3d::Zero(), s.radius)) return false;
  for (int i = 0; i < s.caps; ++i) {
    if (outside(fcl::Vector3d(s.x[i], s.y[i], s.z[i]), s.r[i])) return false;
  }
  return true;
}

}  // namespace kios::paper
