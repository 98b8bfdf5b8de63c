// SPDX-FileCopyrightText: 2026 The fcl_kios authors
// SPDX-License-Identifier: BSD-3-Clause
#include "build/four_axes.h"

#include <Eigen/Geometry>
#include <cmath>

#include "volume/rounding.h"

namespace kios {
namespace {

using lanes::broadcast;
using lanes::Float4;
using lanes::Int4;
using lanes::select;

/// cos(acos(r) / 3) for r in [0, 1], the root of 4 c^3 - 3 c = r above 0.866: from a chord, by
/// Newton's steps.
Float4 cosOfThird(Float4 r) {
  constexpr float kAtZero = 0.8660254F;
  Float4 c = kAtZero + (1 - kAtZero) * r;
  for (int step = 0; step < 2; ++step) {
    const Float4 square = c * c;
    c -= ((4 * square - 3) * c - r) / (12 * square - 3);
  }
  return c;
}

}  // namespace

void acrossAny(const Float4 (&e)[3], Float4 (&out)[3]) {
  const Int4 by_x = lanes::abs(e[0]) > lanes::abs(e[2]);
  const Float4 zero = broadcast(0);
  const Float4 x = select(by_x, -e[1], zero), y = select(by_x, e[0], -e[2]),
               z = select(by_x, zero, e[1]);
  const Float4 by_length = 1 / lanes::sqrt(lanes::max(x * x + y * y + z * z, broadcast(1e-20F)));
  out[0] = x * by_length;
  out[1] = y * by_length;
  out[2] = z * by_length;
}

// The eigenvalue that lies farthest from the other two is single, if any is: its eigenvector is the
// largest cross product of two rows of A - lambda. In the plane across it the rest is a rotation.
FourAxes principalAxes(const Scatter<Float4>& s) {
  const Float4 one = broadcast(1), zero = broadcast(0);
  const Float4 trace = s.xx + s.yy + s.zz;
  Int4 usable = (trace > broadcast(1e-30F)) & (trace < broadcast(1e30F));
  for (const Float4& entry : {s.xx, s.xy, s.xz, s.yy, s.yz, s.zz}) {
    usable &= lanes::abs(entry) <= trace;  // as in every scatter matrix
  }
  const Float4 unit = 1 / select(usable, trace, one);
  const auto scaled = [&](Float4 v) { return select(usable, v * unit, zero); };
  const Float4 third = broadcast(1.0F / 3);
  const Float4 xx = scaled(s.xx) - third, yy = scaled(s.yy) - third, zz = scaled(s.zz) - third;
  const Float4 xy = scaled(s.xy), xz = scaled(s.xz), yz = scaled(s.yz);
  const Float4 squares = xx * xx + yy * yy + zz * zz + 2 * (xy * xy + xz * xz + yz * yz);
  const Float4 p = lanes::sqrt(squares * (1.0F / 6));
  usable &= p > broadcast(1e-4F);
  const Float4 safe_p = select(usable, p, one);
  const Float4 determinant =
      xx * (yy * zz - yz * yz) - xy * (xy * zz - yz * xz) + xz * (xy * yz - yy * xz);
  const Float4 r = 0.5F * determinant / (safe_p * safe_p * safe_p);
  const Float4 c = 2 * safe_p * cosOfThird(lanes::min(lanes::abs(r), one));
  const Float4 lambda = select(r < zero, -c, c);
  const Float4 a = xx - lambda, b = yy - lambda, d = zz - lambda;
  // Cross products of rows (a, xy, xz), (xy, b, yz), (xz, yz, d).
  const Float4 c01[3] = {xy * yz - xz * b, xz * xy - a * yz, a * b - xy * xy};
  const Float4 c02[3] = {xy * d - xz * yz, xz * xz - a * d, a * yz - xy * xz};
  const Float4 c12[3] = {b * d - yz * yz, yz * xz - xy * d, xy * yz - b * xz};
  const auto squared = [](const Float4* v) { return v[0] * v[0] + v[1] * v[1] + v[2] * v[2]; };
  const Float4 q01 = squared(c01), q02 = squared(c02), q12 = squared(c12);
  const Float4 most = lanes::max(lanes::max(q01, q02), q12);
  usable &= most > broadcast(1e-20F);
  const Float4 by_length = 1 / lanes::sqrt(select(usable, most, one));
  const Int4 is01 = q01 >= most, is02 = q02 >= most;
  FourAxes axes;
  Float4(&e)[3] = axes.column[0];
  for (int k = 0; k < 3; ++k) {
    const Float4 v = select(is01, c01[k], select(is02, c02[k], c12[k])) * by_length;
    e[k] = select(usable, v, broadcast(k == 0 ? 1 : 0));
  }
  Float4 u[3];
  acrossAny(e, u);
  const Float4 v[3] = {e[1] * u[2] - e[2] * u[1], e[2] * u[0] - e[0] * u[2],
                       e[0] * u[1] - e[1] * u[0]};
  const Float4 au[3] = {xx * u[0] + xy * u[1] + xz * u[2], xy * u[0] + yy * u[1] + yz * u[2],
                        xz * u[0] + yz * u[1] + zz * u[2]};
  const Float4 av[3] = {xx * v[0] + xy * v[1] + xz * v[2], xy * v[0] + yy * v[1] + yz * v[2],
                        xz * v[0] + yz * v[1] + zz * v[2]};
  const Float4 uu = u[0] * au[0] + u[1] * au[1] + u[2] * au[2];
  const Float4 uv = v[0] * au[0] + v[1] * au[1] + v[2] * au[2];
  const Float4 vv = v[0] * av[0] + v[1] * av[1] + v[2] * av[2];
  // tan(2 t) = 2 uv / (uu - vv).
  const Float4 half = 0.5F * (uu - vv), radius = lanes::sqrt(half * half + uv * uv);
  const Int4 turns = usable & (radius > broadcast(1e-7F));
  const Float4 safe_radius = select(turns, radius, one);
  const Float4 larger = lanes::sqrt(0.5F + 0.5F * lanes::min(lanes::abs(half) / safe_radius, one));
  const Float4 smaller = 0.5F * uv / (safe_radius * larger);
  const Int4 first = half >= zero;
  const Float4 cosine = select(turns, select(first, larger, lanes::abs(smaller)), one);
  const Float4 sine =
      select(turns, select(first, smaller, select(uv >= zero, larger, -larger)), zero);
  for (int k = 0; k < 3; ++k) {
    axes.column[1][k] = cosine * u[k] + sine * v[k];
    axes.column[2][k] = cosine * v[k] - sine * u[k];
  }
  return axes;
}

Eigen::Matrix3f axesAlong(const Eigen::Vector3f& a, const Eigen::Vector3f& b) {
  Eigen::Matrix3d axes = Eigen::Matrix3d::Identity();
  const Eigen::Vector3d first = a.cast<double>(), second = b.cast<double>();
  const double square = first.dot(first), square_b = second.dot(second);
  if (square > 0 && square < kInfinity) axes.col(0) = first / std::sqrt(square);
  Eigen::Vector3d across = second - axes.col(0).dot(second) * axes.col(0);
  double left = across.dot(across);
  if (!(left > 1e-6 * square_b && left < kInfinity)) {  // any direction across the first
    int least = 0;
    axes.col(0).cwiseAbs().minCoeff(&least);
    across = Eigen::Vector3d::Unit(least) - axes(least, 0) * axes.col(0);
    left = across.dot(across);
  }
  axes.col(1) = across / std::sqrt(left);
  axes.col(2) = axes.col(0).cross(axes.col(1));
  return roundedTo<float>(axes);
}

}  // namespace kios
