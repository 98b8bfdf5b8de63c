// SPDX-FileCopyrightText: 2026 The fcl_kios authors
// SPDX-License-Identifier: BSD-3-Clause
#include "tree/moment_fit.h"

#include "tree/node_layout.h"

#include <Eigen/Eigenvalues>
#include <algorithm>
#include <cmath>

#include "fcl_kios/detail/rigid.h"
#include "volume/assemble.h"
#include "volume/lanes.h"
#include "volume/rounding.h"

namespace kios::engine {
namespace {

using lanes::broadcast;
using lanes::Float4;

/// Longest first.
Eigen::Matrix3f principalAxes(const Scatter<double>& m) {
  const double trace = m.xx + m.yy + m.zz;
  if (!(trace > 0)) return Eigen::Matrix3f::Identity();
  Eigen::Matrix3d scatter;
  scatter << m.xx, m.xy, m.xz, m.xy, m.yy, m.yz, m.xz, m.yz, m.zz;
  Eigen::SelfAdjointEigenSolver<Eigen::Matrix3f> solver;
  solver.computeDirect(roundedTo<float>(scatter / trace));
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

void Moments::add(const Moments& o) {
  const double sum = n + o.n;
  if (!(sum > 0)) return;
  const Eigen::Vector3d d = o.mean - mean;
  const double weight = n * o.n / sum;
  scatter.xx += o.scatter.xx + weight * d[0] * d[0];
  scatter.xy += o.scatter.xy + weight * d[0] * d[1];
  scatter.xz += o.scatter.xz + weight * d[0] * d[2];
  scatter.yy += o.scatter.yy + weight * d[1] * d[1];
  scatter.yz += o.scatter.yz + weight * d[1] * d[2];
  scatter.zz += o.scatter.zz + weight * d[2] * d[2];
  mean += o.n / sum * d;
  n = sum;
}

Moments momentsOf(const Eigen::Vector3f* points, int n) {
  const Eigen::Vector3d from = points[0].cast<double>();
  Moments m;
  Scatter<double>& s = m.scatter;
  for (int i = 1; i < n; ++i) {
    s.add(points[i][0] - from[0], points[i][1] - from[1], points[i][2] - from[2]);
  }
  const double part = 1.0 / n;
  m.n = n;
  m.mean = from + part * Eigen::Vector3d(s.x, s.y, s.z);
  s.center(part);
  return m;
}

// Points and centres are floats as they stand: a distance has 4.5 roundings, its root's included.
void encloseAll(const PointChunk* chunks, std::size_t num_chunks,
                const Eigen::Vector3f (&centers)[kSphereRows], Node& node) {
  Float4 squares[kSphereRows];
  for (Float4& square : squares) square = broadcast(0);
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
  double radii[kSphereRows];
  for (int s = 0; s < kSphereRows; ++s) {
    radii[s] = std::sqrt(double{lanes::horizontalMax(squares[s])}) * (1 + 8 * kUlpFloat) + 0x1p-74;
  }
  writeSpheres(centers, radii, node);
}

Eigen::Matrix3f axesOf(const Eigen::Vector3f (&centers)[kSphereRows], const PointChunk* chunks,
                       std::size_t num_chunks) {
  if (centers[3] != centers[4]) return axesAlong(centers[1] - centers[2], centers[3] - centers[4]);
  Moments m;
  for (std::size_t i = 0; i < num_chunks; ++i) {
    Eigen::Vector3f points[kLanes];
    for (int l = 0; l < kLanes; ++l)
      points[l] = {chunks[i].x.v[l], chunks[i].y.v[l], chunks[i].z.v[l]};
    m.add(momentsOf(points, kLanes));
  }
  return principalAxes(m.scatter);
}

Box boxAround(const Eigen::Matrix3f& axes, const PointChunk* chunks, std::size_t num_chunks) {
  const Extents e = extentsAlong(axes, chunks, num_chunks);
  return boxOf(axes, e, e.from + detail::rotate<float>(axes, 0.5F * (e.low + e.high)));
}

void momentFit(const PointChunk* chunks, std::size_t num_chunks, const Moments& moments, Node& node,
               Box* box) {
  const Eigen::Matrix3f axes = principalAxes(moments.scatter);
  const Extents e = extentsAlong(axes, chunks, num_chunks);
  const Eigen::Vector3f half = 0.5F * (e.high - e.low);
  const Eigen::Vector3f center = e.from + detail::rotate<float>(axes, 0.5F * (e.low + e.high));
  const auto order = longestFirst(half);

  // Caps across the shortest and the middle axis, at the fit's half opening angle of 30 degrees.
  Eigen::Vector3f to_cap[2];
  for (int pair = 0; pair < 2; ++pair) {
    const int axis = order[2 - pair];
    const float u = half[(axis + 1) % 3], v = half[(axis + 2) % 3];
    const float height = std::max(0.0F, kCot30 * std::sqrt(u * u + v * v) - half[axis]);
    to_cap[pair] = height * axes.col(axis);
  }
  const Eigen::Vector3f centers[kSphereRows] = {center, center + to_cap[0], center - to_cap[0],
                                                center + to_cap[1], center - to_cap[1]};
  encloseAll(chunks, num_chunks, centers, node);
  if (box) {
    *box = boxOf(axes, e, center);
    node.flat = isFlat(*box);
  }
}

}  // namespace kios::engine
