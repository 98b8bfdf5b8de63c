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

SphereCenters triangleCenters(const PointLanes& points, PrincipalFrame& frame) {
  const Eigen::Vector3f p[3] = {Eigen::Vector3f::Zero(),
                                {points.x()[1], points.y()[1], points.z()[1]},
                                {points.x()[2], points.y()[2], points.z()[2]}};
  const float squares[3] = {(p[2] - p[1]).squaredNorm(), p[2].squaredNorm(), p[1].squaredNorm()};
  int apex = squares[0] >= squares[1] ? 0 : 1;  // opposite the longest edge
  if (squares[2] > squares[apex]) apex = 2;
  const Eigen::Vector3f &from = p[(apex + 1) % 3], &to = p[(apex + 2) % 3];
  const Eigen::Vector3f middle = 0.5F * (from + to);
  const Eigen::Vector3f to_apex = p[apex] - middle;
  frame.axes = orthonormalAxes(to - from, to_apex);
  for (int c = 0; c < 3; ++c) frame.middle[c] = frame.axes.col(c).dot(middle);

  SphereCenters centers;
  // In the plane: the longest edge from (-a, 0) to (a, 0), the apex at (x, h), |x| <= a.
  const float a = 0.5F * std::sqrt(squares[apex]);
  const float x = frame.axes.col(0).dot(to_apex), h = frame.axes.col(1).dot(to_apex);
  if (!(a > 0)) return centers;
  centers.k = 5;
  const float rise = x * x + h * h - a * a;  // > 0: acute, the circumcircle is the minimal one
  const float v0 = rise > 0 && h > 0 ? 0.5F * rise / h : 0.0F;
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
