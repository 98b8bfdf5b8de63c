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

}  // namespace kios
