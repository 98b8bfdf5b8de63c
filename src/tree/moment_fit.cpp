// SPDX-FileCopyrightText: 2026 The fcl_kios authors
// SPDX-License-Identifier: BSD-3-Clause
#include "tree/moment_fit.h"

#include "tree/node_layout.h"

#include <Eigen/Eigenvalues>
#include <algorithm>
#include <cmath>
#include <type_traits>

#include "fcl_kios/volume/rigid.h"
#include "volume/lanes.h"
#include "volume/rounding.h"

namespace kios::engine {
namespace {

using lanes::broadcast;
using lanes::Float4;

/// Longest first.
Eigen::Matrix3f principalAxes(const Moments& m) {
  const double trace = m.xx + m.yy + m.zz;
  if (!(trace > 0)) return Eigen::Matrix3f::Identity();
  Eigen::Matrix3f scatter;
  scatter << static_cast<float>(m.xx / trace), static_cast<float>(m.xy / trace),
      static_cast<float>(m.xz / trace), static_cast<float>(m.xy / trace),
      static_cast<float>(m.yy / trace), static_cast<float>(m.yz / trace),
      static_cast<float>(m.xz / trace), static_cast<float>(m.yz / trace),
      static_cast<float>(m.zz / trace);
  Eigen::SelfAdjointEigenSolver<Eigen::Matrix3f> solver;
  solver.computeDirect(scatter);
  return axesAlong(solver.eigenvectors().col(2), solver.eigenvectors().col(1));
}

/// The extents of points along axes, relative to `from`, one of the points.
struct Extents {
  Eigen::Vector3f from, low, high;
};

Extents extentsAlong(const Eigen::Matrix3f& axes, const PointChunk* chunks, std::size_t n) {
  Extents e;
  e.from = {chunks[0].x.v[0], chunks[0].y.v[0], chunks[0].z.v[0]};
  Float4 low[3], high[3];
  for (int k = 0; k < 3; ++k) low[k] = high[k] = broadcast(0);
  for (std::size_t i = 0; i < n; ++i) {
    for (int l = 0; l < kLanes; l += 4) {
      const Float4 x = lanes::load(chunks[i].x.v + l) - e.from[0];
      const Float4 y = lanes::load(chunks[i].y.v + l) - e.from[1];
      const Float4 z = lanes::load(chunks[i].z.v + l) - e.from[2];
      for (int k = 0; k < 3; ++k) {
        const Float4 h = x * axes(0, k) + y * axes(1, k) + z * axes(2, k);
        low[k] = lanes::min(low[k], h);
        high[k] = lanes::max(high[k], h);
      }
    }
  }
  for (int k = 0; k < 3; ++k) {
    e.low[k] = lanes::horizontalMin(low[k]);
    e.high[k] = lanes::horizontalMax(high[k]);
  }
  return e;
}

// A height is off by 5 u of |p - from|_1 (u = 2^-24), which the sum of extents bounds twice; the
// box is measured from its centre as stored.
Box boxOf(const Eigen::Matrix3f& axes, const Extents& e, const Eigen::Vector3f& center) {
  const Eigen::Vector3d to_center = center.cast<double>() - e.from.cast<double>();
  const double error = 16 * kUlpFloat * double{(e.high - e.low).sum()};
  Box box = {};
  box.x[kCenter] = center[0];
  box.y[kCenter] = center[1];
  box.z[kCenter] = center[2];
  for (int k = 0; k < 3; ++k) {
    const double at = axes.col(k).cast<double>().dot(to_center);
    box.x[k] = axes(0, k);
    box.y[k] = axes(1, k);
    box.z[k] = axes(2, k);
    box.half[k] = roundUpFloat(std::max(double{e.high[k]} - at, at - double{e.low[k]}) + error);
  }
  return box;
}

}  // namespace

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
  return axes.cast<float>();
}

void Moments::add(const Moments& o) {
  const double sum = n + o.n;
  if (!(sum > 0)) return;
  const Eigen::Vector3d d = o.mean - mean;
  const double weight = n * o.n / sum;
  xx += o.xx + weight * d[0] * d[0];
  xy += o.xy + weight * d[0] * d[1];
  xz += o.xz + weight * d[0] * d[2];
  yy += o.yy + weight * d[1] * d[1];
  yz += o.yz + weight * d[1] * d[2];
  zz += o.zz + weight * d[2] * d[2];
  mean += o.n / sum * d;
  n = sum;
}

Moments momentsOf(const Eigen::Vector3f* points, int n) {
  const Eigen::Vector3d from = points[0].cast<double>();
  double x = 0, y = 0, z = 0;
  Moments m;
  for (int i = 1; i < n; ++i) {
    const double dx = points[i][0] - from[0], dy = points[i][1] - from[1],
                 dz = points[i][2] - from[2];
    x += dx;
    y += dy;
    z += dz;
    m.xx += dx * dx;
    m.xy += dx * dy;
    m.xz += dx * dz;
    m.yy += dy * dy;
    m.yz += dy * dz;
    m.zz += dz * dz;
  }
  const double part = 1.0 / n;
  m.n = n;
  m.mean = from + part * Eigen::Vector3d(x, y, z);
  m.xx -= part * x * x;
  m.xy -= part * x * y;
  m.xz -= part * x * z;
  m.yy -= part * y * y;
  m.yz -= part * y * z;
  m.zz -= part * z * z;
  return m;
}

// Points and S0's centre are floats as they stand: a distance has 4.5 roundings, its root's
// included. A cap's centre is the sum of two floats, off by at most u a coordinate.
void measureSpheres(const PointChunk* chunks, std::size_t num_chunks, kIOS<float>& bv) {
  const int k = bv.k();
  Float4 cx[5], cy[5], cz[5], squares[5];
  double shift[5] = {};
  for (int s = 0; s < k; ++s) {
    const float x = s == 0 ? bv.center0[0] : bv.center0[0] + bv.cap_x[s - 1];
    const float y = s == 0 ? bv.center0[1] : bv.center0[1] + bv.cap_y[s - 1];
    const float z = s == 0 ? bv.center0[2] : bv.center0[2] + bv.cap_z[s - 1];
    if (s > 0)
      shift[s] = kUlpFloat * (std::abs(double{x}) + std::abs(double{y}) + std::abs(double{z}));
    cx[s] = broadcast(x);
    cy[s] = broadcast(y);
    cz[s] = broadcast(z);
    squares[s] = broadcast(0);
  }
  const auto pass = [&](auto count) {
    for (std::size_t i = 0; i < num_chunks; ++i) {
      for (int l = 0; l < kLanes; l += 4) {
        const Float4 x = lanes::load(chunks[i].x.v + l), y = lanes::load(chunks[i].y.v + l),
                     z = lanes::load(chunks[i].z.v + l);
        for (int s = 0; s < count(); ++s) {
          const Float4 dx = x - cx[s], dy = y - cy[s], dz = z - cz[s];
          squares[s] = lanes::max(squares[s], dx * dx + dy * dy + dz * dz);
        }
      }
    }
  };
  if (k == 5) {
    pass(std::integral_constant<int, 5>());
  } else {
    pass([k] { return k; });
  }
  const auto radius = [&](int s) {
    return roundUpFloat(std::sqrt(double{lanes::horizontalMax(squares[s])}) * (1 + 8 * kUlpFloat) +
                        shift[s] + 0x1p-74);
  };
  bv.radius0 = radius(0);
  for (int s = 1; s < k; ++s) bv.cap_r[s - 1] = radius(s);
}

Eigen::Matrix3f axesOf(const kIOS<float>& bv, const PointChunk* chunks, std::size_t num_chunks) {
  if (bv.k() == 5) {
    const auto between = [&](int i) {
      return Eigen::Vector3f(bv.cap_x[i] - bv.cap_x[i + 1], bv.cap_y[i] - bv.cap_y[i + 1],
                             bv.cap_z[i] - bv.cap_z[i + 1]);
    };
    return axesAlong(between(0), between(2));
  }
  Moments m;
  for (std::size_t i = 0; i < num_chunks; ++i) {
    Eigen::Vector3f points[kLanes];
    for (int l = 0; l < kLanes; ++l)
      points[l] = {chunks[i].x.v[l], chunks[i].y.v[l], chunks[i].z.v[l]};
    m.add(momentsOf(points, kLanes));
  }
  return principalAxes(m);
}

Box boxAround(const Eigen::Matrix3f& axes, const PointChunk* chunks, std::size_t num_chunks) {
  const Extents e = extentsAlong(axes, chunks, num_chunks);
  return boxOf(axes, e, e.from + detail::rotate<float>(axes, 0.5F * (e.low + e.high)));
}

void momentFit(const PointChunk* chunks, std::size_t num_chunks, const Moments& moments, Node& node,
               Box* box) {
  const Eigen::Matrix3f axes = principalAxes(moments);
  const Extents e = extentsAlong(axes, chunks, num_chunks);
  const Eigen::Vector3f half = 0.5F * (e.high - e.low);
  const Eigen::Vector3f center = e.from + detail::rotate<float>(axes, 0.5F * (e.low + e.high));
  int order[3] = {0, 1, 2};  // longest first
  if (half[order[0]] < half[order[1]]) std::swap(order[0], order[1]);
  if (half[order[1]] < half[order[2]]) std::swap(order[1], order[2]);
  if (half[order[0]] < half[order[1]]) std::swap(order[0], order[1]);

  // Caps across the shortest and the middle axis, at the fit's half opening angle of 30 degrees.
  Eigen::Vector3f to_cap[2];
  for (int pair = 0; pair < 2; ++pair) {
    constexpr float kCot30 = 1.7320508F;
    const int axis = order[2 - pair];
    const float u = half[(axis + 1) % 3], v = half[(axis + 2) % 3];
    const float height = std::max(0.0F, kCot30 * std::sqrt(u * u + v * v) - half[axis]);
    to_cap[pair] = height * axes.col(axis);
  }
  const Eigen::Vector3f centers[kSphereRows] = {center, center + to_cap[0], center - to_cap[0],
                                                center + to_cap[1], center - to_cap[1]};
  Float4 squares[kSphereRows];
  for (Float4& s : squares) s = broadcast(0);
  for (std::size_t i = 0; i < num_chunks; ++i) {
    for (int l = 0; l < kLanes; l += 4) {
      const Float4 x = lanes::load(chunks[i].x.v + l), y = lanes::load(chunks[i].y.v + l),
                   z = lanes::load(chunks[i].z.v + l);
      for (int s = 0; s < kSphereRows; ++s) {
        const Float4 dx = x - centers[s][0], dy = y - centers[s][1], dz = z - centers[s][2];
        squares[s] = lanes::max(squares[s], dx * dx + dy * dy + dz * dz);
      }
    }
  }
  // Points and centres are floats as they stand: a distance has 4.5 roundings, its root's included.
  // A cap's centre is middle +- half, off by at most u a coordinate from what was measured.
  const auto radius = [&](int s) {
    return std::sqrt(double{lanes::horizontalMax(squares[s])}) * (1 + 8 * kUlpFloat) + 0x1p-74;
  };
  const auto write = [&](int row, const Eigen::Vector3f& place) {
    node.x[row] = place[0];
    node.y[row] = place[1];
    node.z[row] = place[2];
  };
  write(kCentral, center);
  node.r[kCentral] = node.size = roundUpFloat(radius(0));
  for (int pair = 0; pair < 2; ++pair) {
    const int middle = pair == 0 ? kMiddle2 : kMiddle1, plus = 1 + 2 * pair, minus = plus + 1;
    write(middle, center);
    write(middle + 1, to_cap[pair]);
    const double shift =
        kUlpFloat * double{std::max(centers[plus].lpNorm<1>(), centers[minus].lpNorm<1>())};
    const double r_plus = radius(plus), r_minus = radius(minus);
    node.r[middle + 1] = static_cast<float>(0.5 * (r_plus - r_minus));
    node.r[middle] = roundUpFloat(0.5 * (r_plus + r_minus) + shift +
                                  kUlpFloat * 0.5 * std::abs(r_plus - r_minus));
  }
  if (box) {
    *box = boxOf(axes, e, center);
    node.flat = isFlat(*box);
  }
}

}  // namespace kios::engine
