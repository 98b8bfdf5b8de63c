// SPDX-FileCopyrightText: 2026 The fcl_kios authors
// SPDX-License-Identifier: BSD-3-Clause
#include "build/sphere_centers.h"

#include <algorithm>
#include <cmath>

#include "build/recenter.h"
#include "volume/assemble.h"

namespace kios {
namespace {

/// Sine, cosine and cotangent of the half opening angle, pi/6 as constants.
struct Opening {
  double sine = 0.5, cosine = 0.8660254037844386;
  float cotangent = kCot30;

  explicit Opening(double angle) {
    if (angle == FitOptions::kPublishedAngle) return;
    sine = std::sin(angle);
    cosine = std::cos(angle);
    cotangent = static_cast<float>(cosine / sine);
  }
};

/// The spheres that a node with the half extents a >= b >= c is given: paper, III-C. The case
/// a/b > 1.5 and a/c < 1.5, which it leaves out, can't occur; a ratio of 1.5 counts as below it.
template <typename Real>
int sphereCount(Real a, Real b, Real c, Real ratio, SphereCount count, int most) {
  if (!(a > 0)) return 1;
  if (count != SphereCount::kByRatio) return most;
  return a <= ratio * c ? 1 : std::min(most, a <= ratio * b ? 3 : most);
}

constexpr double kPublishedRatio = 1.5;

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

SphereCenters tunedCenters(const PointLanes& in_frame, const PrincipalFrame& frame,
                           const FitOptions& options, int most) {
  SphereCenters centers;
  const auto& order = frame.order;
  const float a = frame.half[order[0]], b = frame.half[order[1]], c = frame.half[order[2]];
  Support support;
  recenterInPlane(in_frame, order[2], centers.sphere[0], support);
  if (c > 0.08F * a) {  // thick: across the shortest axis as well
    Support across;
    recenterInPlane(in_frame, order[0], centers.sphere[0], across);
  }
  constexpr float kRatio = 1.1F;  // below it the caps of an axis cut off next to nothing
  centers.k = sphereCount(a, b, c, kRatio, options.count, most);
  const float cotangent = Opening(options.angle).cotangent;
  for (int i = 1; i < centers.k; i += 2) {
    const int axis = axisOfCap(frame, i);
    const float height =
        std::max(0.0F, cotangent * lateralRadius(in_frame, axis) - frame.half[axis]);
    for (int side = 0; side < 2; ++side) {
      float* const center = centers.sphere[i + side];
      center[axis] = side == 0 ? height : -height;
      recenterInPlane(in_frame, axis, center, support);
    }
  }
  return centers;
}

SphereCenters publishedCenters(const PointLanes& in_frame, const PrincipalFrame& frame,
                               const FitOptions& options) {
  SphereCenters centers;
  const auto& order = frame.order;
  const double a = frame.half[order[0]], b = frame.half[order[1]], c = frame.half[order[2]];
  centers.k = sphereCount(a, b, c, kPublishedRatio, options.count, 5);
  const double r0_squared = in_frame.farthest(0, 0, 0).squared_distance;
  const Opening opening(options.angle);
  const double r1 = std::sqrt(std::max(0.0, r0_squared - c * c)) / opening.sine;
  centers.least_cap_radius = r1;
  for (int i = 1; i < centers.k; ++i) {
    const int axis = axisOfCap(frame, i);
    const double height =
        i <= 2 ? r1 * opening.cosine - c : std::sqrt(std::max(0.0, r1 * r1 - a * a - c * c)) - b;
    float* const center = centers.sphere[i];
    const double sign = i % 2 == 1 ? 1 : -1;
    center[axis] = static_cast<float>(sign * height);
    const double r = std::sqrt(in_frame.farthest(center[0], center[1], center[2]).squared_distance);
    center[axis] = static_cast<float>(sign * (height + std::max(0.0, r1 - r)));
  }
  return centers;
}

SphereCenters ellipsoidCenters(const PrincipalFrame& frame, const FitOptions& options) {
  SphereCenters centers;
  const auto& order = frame.order;
  const double a = frame.half[order[0]], b = frame.half[order[1]], c = frame.half[order[2]];
  centers.k = sphereCount(a, b, c, kPublishedRatio, options.count, 5);
  if (!(a > 0)) return centers;  // of a point
  const double least =
      a * (options.method == FitMethod::kMethodI ? 1.0 / 256 : Opening(options.angle).sine);
  const double r1 = a * a / std::max(c, least);
  for (int i = 1; i < centers.k; ++i) {
    const double height = r1 - std::max(i <= 2 ? c : b, least);
    centers.sphere[i][axisOfCap(frame, i)] = static_cast<float>(i % 2 == 1 ? height : -height);
  }
  return centers;
}

SphereCenters inAxesOfPoints(const SphereCenters& in_frame, const PrincipalFrame& frame) {
  SphereCenters centers = in_frame;
  for (int i = 0; i < in_frame.k; ++i) {
    const float* const from = in_frame.sphere[0];
    const float* const to = in_frame.sphere[i];
    float d[3];
    for (int c = 0; c < 3; ++c) d[c] = i == 0 ? frame.middle[c] + to[c] : to[c] - from[c];
    for (int r = 0; r < 3; ++r) {
      centers.sphere[i][r] =
          frame.axes(r, 0) * d[0] + frame.axes(r, 1) * d[1] + frame.axes(r, 2) * d[2];
    }
  }
  return centers;
}

void adjustCenters(const PointLanes& in_frame, const PrincipalFrame& frame,
                   const FitOptions& options, SphereCenters& centers) {
  double radius[SphereCenters::kMost];
  int axis[SphereCenters::kMost] = {};
  for (int i = 0; i < centers.k; ++i) {
    const float* const c = centers.sphere[i];
    radius[i] = std::sqrt(double{in_frame.farthest(c[0], c[1], c[2]).squared_distance});
    if (i == 0) continue;
    axis[i] = axisOfCap(frame, i);
    radius[i] = std::max(radius[i], centers.least_cap_radius);
  }
  if (options.count == SphereCount::kByGain) {
    constexpr double kLeastGain = 0.1;
    int kept = 1;
    for (int i = 1; i < centers.k; i += 2) {
      // The part of S0 that the far sides of the two caps leave.
      const double middle = centers.sphere[0][axis[i]];
      const double top =
          std::min(middle + radius[0], centers.sphere[i + 1][axis[i]] + radius[i + 1]);
      const double bottom = std::max(middle - radius[0], centers.sphere[i][axis[i]] - radius[i]);
      if (!(top - bottom < (1 - kLeastGain) * 2 * radius[0])) continue;
      for (int side = 0; side < 2; ++side, ++kept) {
        std::copy_n(centers.sphere[i + side], 3, centers.sphere[kept]);
        radius[kept] = radius[i + side];
        axis[kept] = axis[i + side];
      }
    }
    centers.k = kept;
  }
  if (options.shared_radius && centers.k > 1) {
    const double shared = *std::max_element(radius + 1, radius + centers.k);
    for (int i = 1; i < centers.k; ++i) {
      const double outwards = i % 2 == 1 ? shared - radius[i] : radius[i] - shared;
      centers.sphere[i][axis[i]] += static_cast<float>(outwards);
    }
    centers.least_cap_radius = shared;
  }
}

}  // namespace kios
