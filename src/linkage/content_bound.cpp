// SPDX-FileCopyrightText: 2026 The fcl_kios authors
// SPDX-License-Identifier: BSD-3-Clause
#include "linkage/content_bound.h"

#include <algorithm>
#include <cmath>

#include <Eigen/Geometry>

namespace kios::articulated {
namespace {

using fcl::Vector3d;

// Covers the roundings below: fewer than 30, each 2^-53 of lengths that `size` bounds.
double grown(double length, double size) { return length + 0x1p-47 * size; }

const Vector3d& farthestFrom(const Vector3d& from, const std::vector<Vector3d>& points) {
  return *std::max_element(points.begin(), points.end(), [&](const Vector3d& a, const Vector3d& b) {
    return (a - from).squaredNorm() < (b - from).squaredNorm();
  });
}

double largest(const std::vector<Vector3d>& points) {
  double square = 0;
  for (const Vector3d& p : points) square = std::max(square, p.squaredNorm());
  return std::sqrt(square);
}

double toSegment(const Vector3d& p, const Vector3d& a, const Vector3d& b) {
  const Vector3d d = b - a;
  const double square = d.squaredNorm();
  const double t = square > 0 ? std::clamp(d.dot(p - a) / square, 0.0, 1.0) : 0.0;
  return (p - a - t * d).norm();
}

}  // namespace

double ContentBound::reach() const {
  const double ball = center.norm() + radius;
  const double capsule = std::max(ends[0].norm(), ends[1].norm()) + capsule_radius;
  return std::min(ball, capsule) * (1 + 0x1p-48);
}

// The capsule lies along the line between two points that are far from each other. Its segment ends
// half a radius before the content does; whatever it is, the radius is measured from it.
ContentBound boundOf(const std::vector<Vector3d>& points, double margin, const Vector3d& center) {
  ContentBound bound;
  const double size = largest(points) + center.norm() + margin;
  bound.center = center;
  bound.radius = grown((farthestFrom(center, points) - center).norm() + margin, size);

  const Vector3d first = farthestFrom(center, points), last = farthestFrom(first, points);
  const double length = (last - first).norm();
  const Vector3d along = length > 0 ? Vector3d((last - first) / length) : Vector3d::UnitX();
  const Vector3d across[2] = {along.unitOrthogonal(), along.cross(along.unitOrthogonal())};
  double low[3] = {HUGE_VAL, HUGE_VAL, HUGE_VAL}, high[3] = {-HUGE_VAL, -HUGE_VAL, -HUGE_VAL};
  for (const Vector3d& p : points) {
    const double at[3] = {along.dot(p), across[0].dot(p), across[1].dot(p)};
    for (int i = 0; i < 3; ++i) {
      low[i] = std::min(low[i], at[i]);
      high[i] = std::max(high[i], at[i]);
    }
  }
  const Vector3d middle =
      across[0] * (0.5 * (low[1] + high[1])) + across[1] * (0.5 * (low[2] + high[2]));
  const double width = 0.5 * std::hypot(high[1] - low[1], high[2] - low[2]);
  const double cut = std::min(0.5 * width, 0.5 * (high[0] - low[0]));
  bound.ends[0] = middle + along * (low[0] + cut);
  bound.ends[1] = middle + along * (high[0] - cut);
  double radius = 0;
  for (const Vector3d& p : points) {
    radius = std::max(radius, toSegment(p, bound.ends[0], bound.ends[1]));
  }
  bound.capsule_radius = grown(radius + margin, 4 * size);
  return bound;
}

}  // namespace kios::articulated
