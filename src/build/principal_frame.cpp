// SPDX-FileCopyrightText: 2026 The fcl_kios authors
// SPDX-License-Identifier: BSD-3-Clause
#include "build/principal_frame.h"

#include <Eigen/Eigenvalues>
#include <algorithm>
#include <cmath>
#include <utility>

#include "build/four_axes.h"
#include "fcl_kios/volume/rigid.h"
#include "volume/rounding.h"

namespace kios {
namespace {

using lanes::Float4;
using lanes::load;

double sum(Float4 v) { return double{v[0]} + v[1] + v[2] + v[3]; }

/// Adds up x, y, z, xx, xy, xz, yy, yz and zz of the points from `begin` to `end`, four a step.
inline void addMoments(const PointLanes& points, int begin, int end, Float4 (&t)[9]) {
  for (int i = begin; i < end; i += 4) {
    const Float4 x = load(points.x() + i), y = load(points.y() + i), z = load(points.z() + i);
    t[0] += x;
    t[1] += y;
    t[2] += z;
    t[3] += x * x;
    t[4] += x * y;
    t[5] += x * z;
    t[6] += y * y;
    t[7] += y * z;
    t[8] += z * z;
  }
}

/// n times the covariance; the padding repeats point 0, the origin, and adds nothing.
Eigen::Matrix3d covariance(const PointLanes& points) {
  double s[9] = {};
  constexpr int kBlock = 1024;  // float sums of at most 256 terms a lane
  for (int begin = 0; begin < points.paddedSize(); begin += kBlock) {
    Float4 t[9] = {};
    addMoments(points, begin, std::min(begin + kBlock, points.paddedSize()), t);
    for (int j = 0; j < 9; ++j) s[j] += sum(t[j]);
  }
  const Eigen::Vector3d first(s[0], s[1], s[2]);
  Eigen::Matrix3d second;
  second << s[3], s[4], s[5], s[4], s[6], s[7], s[5], s[7], s[8];
  return second - first * first.transpose() / points.size();
}

Eigen::Matrix3f axesOf(const PointLanes& points) {
  Eigen::SelfAdjointEigenSolver<Eigen::Matrix3d> solver;
  solver.computeDirect(covariance(points));
  return orthonormalAxes(solver.eigenvectors().col(2).cast<float>(),
                         solver.eigenvectors().col(1).cast<float>());
}

}  // namespace

Eigen::Matrix3f orthonormalAxes(const Eigen::Vector3f& a, Eigen::Vector3f b) {
  constexpr float kTiny = 1e-30F;  // squared; the caller's units make the longest length about 1
  const float square_a = detail::dot<float>(a, a), square_b = detail::dot<float>(b, b);
  const bool usable = square_a > kTiny && square_a < kInfinityFloat;
  const Eigen::Vector3f e0 =
      usable ? Eigen::Vector3f(a / std::sqrt(square_a)) : Eigen::Vector3f::UnitX();
  b -= detail::dot<float>(e0, b) * e0;
  float square = detail::dot<float>(b, b);
  if (!(square > 1e-6F * square_b && square > kTiny)) {  // any direction across e0
    int least = 0;
    e0.cwiseAbs().minCoeff(&least);
    b = Eigen::Vector3f::Unit(least) - e0[least] * e0;
    square = detail::dot<float>(b, b);
  }
  const Eigen::Vector3f e1 = b / std::sqrt(square);
  Eigen::Matrix3f axes;
  axes << e0, e1, e0.cross(e1);
  return axes;
}

namespace {

PrincipalFrame frameAlong(const Eigen::Matrix3f& axes, const PointLanes& points,
                          PointLanes& in_frame) {
  PrincipalFrame frame;
  frame.axes = axes;
  const Eigen::Matrix3f& e = frame.axes;
  in_frame.resize(points.size());
  float* const out[3] = {in_frame.x(), in_frame.y(), in_frame.z()};
  Float4 low[3], high[3];
  for (int k = 0; k < 3; ++k) low[k] = high[k] = lanes::broadcast(0.0F);  // point 0 is the origin
  for (int i = 0; i < points.paddedSize(); i += 4) {
    const Float4 x = load(points.x() + i), y = load(points.y() + i), z = load(points.z() + i);
    for (int k = 0; k < 3; ++k) {
      const Float4 h = x * e(0, k) + y * e(1, k) + z * e(2, k);
      lanes::store(out[k] + i, h);
      low[k] = -lanes::max(-low[k], -h);
      high[k] = lanes::max(high[k], h);
    }
  }
  for (int k = 0; k < 3; ++k) {
    const float lowest = -lanes::horizontalMax(-low[k]), highest = lanes::horizontalMax(high[k]);
    frame.middle[k] = 0.5F * (lowest + highest);
    frame.half[k] = 0.5F * (highest - lowest);
    for (int i = 0; i < points.paddedSize(); i += 4) {
      lanes::store(out[k] + i, load(out[k] + i) - frame.middle[k]);
    }
  }
  const float* const half = frame.half;
  int* const order = frame.order;
  if (half[order[0]] < half[order[1]]) std::swap(order[0], order[1]);
  if (half[order[1]] < half[order[2]]) std::swap(order[1], order[2]);
  if (half[order[0]] < half[order[1]]) std::swap(order[0], order[1]);
  return frame;
}

/// In floats: the axes serve to place spheres only, and need not be exact.
Eigen::Matrix3f quickAxesOf(const PointLanes& points) {
  Float4 t[9] = {};
  addMoments(points, 0, points.paddedSize(), t);
  float s[9];
  for (int j = 0; j < 9; ++j) s[j] = (t[j][0] + t[j][1]) + (t[j][2] + t[j][3]);
  const float part = 1.0F / static_cast<float>(points.size());
  return principalAxes(Scatter{s[3] - part * s[0] * s[0], s[4] - part * s[0] * s[1],
                               s[5] - part * s[0] * s[2], s[6] - part * s[1] * s[1],
                               s[7] - part * s[1] * s[2], s[8] - part * s[2] * s[2]});
}

}  // namespace

PrincipalFrame principalFrame(const PointLanes& points, PointLanes& in_frame) {
  return frameAlong(axesOf(points), points, in_frame);
}

PrincipalFrame quickPrincipalFrame(const PointLanes& points, PointLanes& in_frame) {
  return frameAlong(quickAxesOf(points), points, in_frame);
}

}  // namespace kios
