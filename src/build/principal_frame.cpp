// SPDX-FileCopyrightText: 2026 The fcl_kios authors
// SPDX-License-Identifier: BSD-3-Clause
#include "build/principal_frame.h"

#include <Eigen/Eigenvalues>
#include <algorithm>
#include <cmath>

#include "build/four_axes.h"
#include "volume/rounding.h"

namespace kios {
namespace {

using lanes::Float4;
using lanes::load;

double sum(Float4 v) { return double{v[0]} + v[1] + v[2] + v[3]; }

/// Adds up the points from `begin` to `end`, four a step.
inline Scatter<Float4> scatterOf(const PointLanes& points, int begin, int end) {
  Scatter<Float4> t;
  for (int i = begin; i < end; i += 4) {
    t.add(load(points.x() + i), load(points.y() + i), load(points.z() + i));
  }
  return t;
}

/// n times the covariance; the padding repeats point 0, the origin, and adds nothing.
Eigen::Matrix3d covariance(const PointLanes& points) {
  Eigen::Vector3d first = Eigen::Vector3d::Zero();
  Eigen::Matrix3d second = Eigen::Matrix3d::Zero();
  constexpr int kBlock = 1024;  // float sums of at most 256 terms a lane
  for (int begin = 0; begin < points.paddedSize(); begin += kBlock) {
    const auto t = scatterOf(points, begin, std::min(begin + kBlock, points.paddedSize()));
    first += Eigen::Vector3d(sum(t.x), sum(t.y), sum(t.z));
    const double xy = sum(t.xy), xz = sum(t.xz), yz = sum(t.yz);
    second +=
        (Eigen::Matrix3d() << sum(t.xx), xy, xz, xy, sum(t.yy), yz, xz, yz, sum(t.zz)).finished();
  }
  return second - first * first.transpose() / points.size();
}

Eigen::Matrix3f axesOf(const PointLanes& points) {
  Eigen::SelfAdjointEigenSolver<Eigen::Matrix3d> solver;
  solver.computeDirect(covariance(points));
  return axesAlong(solver.eigenvectors().col(2).cast<float>(),
                   solver.eigenvectors().col(1).cast<float>());
}

PrincipalFrame frameAlong(const Eigen::Matrix3f& axes, const PointLanes& points,
                          PointLanes& in_frame) {
  PrincipalFrame frame;
  frame.axes = axes;
  in_frame.resize(points.size());
  float* const out[3] = {in_frame.x(), in_frame.y(), in_frame.z()};
  Float4 low[3], high[3];
  for (int k = 0; k < 3; ++k) low[k] = high[k] = lanes::broadcast(0.0F);  // point 0 is the origin
  for (int i = 0; i < points.paddedSize(); i += 4) {
    const Float4 x = load(points.x() + i), y = load(points.y() + i), z = load(points.z() + i);
    for (int k = 0; k < 3; ++k) {
      const Float4 h = x * axes(0, k) + y * axes(1, k) + z * axes(2, k);
      lanes::store(out[k] + i, h);
      low[k] = lanes::min(low[k], h);
      high[k] = lanes::max(high[k], h);
    }
  }
  for (int k = 0; k < 3; ++k) {
    const float lowest = lanes::horizontalMin(low[k]), highest = lanes::horizontalMax(high[k]);
    frame.middle[k] = 0.5F * (lowest + highest);
    frame.half[k] = 0.5F * (highest - lowest);
    for (int i = 0; i < points.paddedSize(); i += 4) {
      lanes::store(out[k] + i, load(out[k] + i) - frame.middle[k]);
    }
  }
  frame.order = longestFirst(frame.half);
  return frame;
}

/// In floats: the axes serve to place spheres only, and need not be exact.
Eigen::Matrix3f quickAxesOf(const PointLanes& points) {
  const Scatter<Float4> t = scatterOf(points, 0, points.paddedSize());
  const auto sum = [](Float4 v) { return (v[0] + v[1]) + (v[2] + v[3]); };
  Scatter<float> s = {sum(t.x),  sum(t.y),  sum(t.z),  sum(t.xx), sum(t.xy),
                      sum(t.xz), sum(t.yy), sum(t.yz), sum(t.zz)};
  s.center(1.0F / static_cast<float>(points.size()));
  return principalAxes(s);
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

PrincipalFrame principalFrame(const PointLanes& points, PointLanes& in_frame) {
  return frameAlong(axesOf(points), points, in_frame);
}

PrincipalFrame quickPrincipalFrame(const PointLanes& points, PointLanes& in_frame) {
  return frameAlong(quickAxesOf(points), points, in_frame);
}

}  // namespace kios
