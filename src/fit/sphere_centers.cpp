// SPDX-FileCopyrightText: 2026 The fcl_kios authors
// SPDX-License-Identifier: BSD-3-Clause
#include "fit/sphere_centers.h"

#include <algorithm>
#include <cmath>

#include "fit/enclosing.h"

namespace kios {
namespace {

constexpr float kCot30 = 1.7320508F;

/// Largest distance of a point from the line through the origin along `axis`.
float lateralRadius(const PointLanes& points, int axis) {
  const float* const coordinates[3] = {points.x(), points.y(), points.z()};
  const float* const u = coordinates[(axis + 1) % 3];
  const float* const v = coordinates[(axis + 2) % 3];
  lanes::Float4 best = lanes::broadcast(0.0F);
  for (int i = 0; i < points.paddedSize(); i += 4) {
    const lanes::Float4 a = lanes::load(u + i), b = lanes::load(v + i);
    best = lanes::max(best, a * a + b * b);
  }
  return std::sqrt(lanes::horizontalMax(best));
}

}  // namespace

SphereCenters tunedCenters(const PointLanes& in_frame, const PrincipalFrame& frame) {
  SphereCenters centers;
  const int* order = frame.order;
  const float a = frame.half[order[0]], b = frame.half[order[1]], c = frame.half[order[2]];
  Support support;
  recenterInPlane(in_frame, order[2], centers.sphere[0], support);
  if (c > 0.08F * a) {  // thick: across the shortest axis as well
    Support across;
    recenterInPlane(in_frame, order[0], centers.sphere[0], across);
  }
  constexpr float kRatio = 1.1F;  // below it the caps of an axis cut off next to nothing
  centers.k = a <= kRatio * c ? 1 : (a <= kRatio * b ? 3 : 5);
  for (int i = 1; i < centers.k; i += 2) {
    const int axis = i == 1 ? order[2] : order[1];
    const float height = std::max(0.0F, kCot30 * lateralRadius(in_frame, axis) - frame.half[axis]);
    for (int side = 0; side < 2; ++side) {
      float* const center = centers.sphere[i + side];
      center[axis] = side == 0 ? height : -height;
      recenterInPlane(in_frame, axis, center, support);
    }
  }
  return centers;
}

SphereCenters publishedCenters(const PointLanes& in_frame, const PrincipalFrame& frame) {
  SphereCenters centers;
  const int* order = frame.order;
  const double a = frame.half[order[0]], b = frame.half[order[1]], c = frame.half[order[2]];
  constexpr double kRatio = 1.5;
  centers.k = a <= kRatio * c ? 1 : (a <= kRatio * b ? 3 : 5);
  const double r0_squared = in_frame.farthest(0, 0, 0).squared_distance;
  constexpr double kSine = 0.5, kCosine = 0.8660254037844386;
  const double r1 = std::sqrt(std::max(0.0, r0_squared - c * c)) / kSine;
  centers.least_cap_radius = r1;
  for (int i = 1; i < centers.k; ++i) {
    const int axis = i <= 2 ? order[2] : order[1];
    const double height =
        i <= 2 ? r1 * kCosine - c : std::sqrt(std::max(0.0, r1 * r1 - a * a - c * c)) - b;
    float* const center = centers.sphere[i];
    const double sign = i % 2 == 1 ? 1 : -1;
    center[axis] = static_cast<float>(sign * height);
    const double r = std::sqrt(in_frame.farthest(center[0], center[1], center[2]).squared_distance);
    center[axis] = static_cast<float>(sign * (height + std::max(0.0, r1 - r)));
  }
  return centers;
}

SphereCenters triangleCenters(const Eigen::Vector3d& p1, const Eigen::Vector3d& p2,
                              PrincipalFrame& frame) {
  const Eigen::Vector3d p[3] = {Eigen::Vector3d::Zero(), p1, p2};
  const double squares[3] = {(p2 - p1).squaredNorm(), p2.squaredNorm(), p1.squaredNorm()};
  int apex = squares[0] >= squares[1] ? 0 : 1;  // opposite the longest edge
  if (squares[2] > squares[apex]) apex = 2;
  const Eigen::Vector3d &from = p[(apex + 1) % 3], &to = p[(apex + 2) % 3];
  const Eigen::Vector3d middle = 0.5 * (from + to), edge = to - from;
  const Eigen::Vector3d from_nearer = p[apex] - ((p[apex] - middle).dot(edge) > 0 ? to : from);

  SphereCenters centers;
  // In the plane: the longest edge from (-a, 0) to (a, 0), the apex at (x, h), |x| <= a. What may
  // be small is measured from the nearer end: slivers would lose it from the middle.
  const double length = std::sqrt(squares[apex]);
  const float a = static_cast<float>(0.5 * length);
  if (!(a > 0)) return centers;
  const Eigen::Vector3d across = from_nearer - from_nearer.dot(edge) / squares[apex] * edge;
  frame.axes = orthonormalAxes(edge.cast<float>(), across.cast<float>());
  for (int c = 0; c < 3; ++c) frame.middle[c] = frame.axes.col(c).dot(middle.cast<float>());
  const float x = static_cast<float>((p[apex] - middle).dot(edge) / length);
  const float h = static_cast<float>(across.norm());
  centers.k = 5;
  // Acute if the apex lies outside the ball over the longest edge: then the circumcentre, which is
  // at most a / sqrt(3) above that edge, is the minimal circle's.
  const double rise = (p[apex] - from).dot(p[apex] - to);
  const float v0 =
      rise > 0 && h > 0 ? std::min(0.5774F * a, static_cast<float>(0.5 * rise / h)) : 0.0F;
  for (int i = 0; i < 3; ++i) centers.sphere[i][1] = v0;
  const float height = kCot30 * std::sqrt(a * a + v0 * v0);
  centers.sphere[1][2] = height;
  centers.sphere[2][2] = -height;
  for (int i = 3; i < 5; ++i) {
    const float from_box = kCot30 * a - 0.5F * h;
    const float v = 0.5F * h + (i == 3 ? from_box : -from_box);
    // Along the edge: its middle, unless the apex is farther; then level with the far end.
    const float weight_edge = v * v, weight_apex = (h - v) * (h - v);
    float u = 0;
    if (x * x + weight_apex > a * a + weight_edge) {
      const float end = x > 0 ? -a : a;
      u = 0.5F * (x * x - a * a + weight_apex - weight_edge) / (x - end);
      u = x > 0 ? std::min(u, x) : std::max(u, x);
    }
    centers.sphere[i][0] = u;
    centers.sphere[i][1] = v;
  }
  return centers;
}

}  // namespace kios
