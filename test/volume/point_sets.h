// SPDX-FileCopyrightText: 2026 The fcl_kios authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cmath>
#include <vector>

#include <fcl/common/types.h>
#include "scenes/random.h"

namespace kios::testing {

using scenes::Random;

template <typename S>
using Points = std::vector<fcl::Vector3<S>>;

inline int below(Random& random, int n) { return static_cast<int>(random.unit() * n); }

/// Names the shapes of content that are hard for a fit, a merge or a bound, each posed on purpose.
enum class PointShape {
  kRandom,
  kCoplanar,
  kCollinear,
  kEqual,
  kTwoClusters,
  kSliver,  ///< aspects to 1e12, every third point near an end
  kNearSphere,
  kTriangle,  ///< right, obtuse or acute vertices, repeated
  kLattice,
  kMixedMagnitudes,
  kAxis,  ///< on the coordinate axes, zeros of both signs
};
constexpr int kPointShapes = 11;

inline fcl::Matrix3d randomRotation(Random& random) {
  fcl::Quaterniond q(random.uniform(-1, 1), random.uniform(-1, 1), random.uniform(-1, 1),
                     random.uniform(-1, 1));
  if (!(q.norm() > 1e-3)) q = fcl::Quaterniond::Identity();
  return q.normalized().toRotationMatrix();
}

/// R, then turned by |w| about w.
inline fcl::Matrix3d turned(const fcl::Vector3d& w, const fcl::Matrix3d& R) {
  const double angle = w.norm();
  if (angle == 0) return R;
  return fcl::AngleAxisd(angle, w / angle).toRotationMatrix() * R;
}

inline fcl::Vector3d randomDirection(Random& random) {
  return randomRotation(random) * fcl::Vector3d::UnitX();
}

/// Returns n points of a shape, of size about 1, around the origin.
inline Points<double> shapePoints(Random& random, PointShape shape, int n) {
  const auto u = [&] { return random.uniform(-1, 1); };
  const double thin = std::pow(10.0, -random.uniform(0, 12)), size = random.uniform(0.1, 1);
  const fcl::Vector3d p0(u(), u(), u());
  const double angle = random.uniform(0.01, 3.13);
  const double corner[3][2] = {
      {0, 0}, {1, 0}, {size * std::cos(angle), size * std::sin(angle) * (n % 2 ? 1 : thin)}};
  Points<double> points(n);
  for (int i = 0; i < n; ++i) {
    fcl::Vector3d& p = points[i];
    p << u(), u(), u();
    switch (shape) {
      case PointShape::kRandom:
        p = p.cwiseProduct(fcl::Vector3d(1, size, size * size));
        break;
      case PointShape::kCoplanar:
        p[2] = 0;
        break;
      case PointShape::kCollinear:
        p[1] = p[2] = 0;
        break;
      case PointShape::kEqual:
        p = p0;
        break;
      case PointShape::kTwoClusters:
        p = (i % 2 ? p0 : -p0) + thin * p;
        break;
      case PointShape::kSliver:
        if (i % 3 == 2) p[0] = 1 - thin * p[0];
        p = p.cwiseProduct(fcl::Vector3d(1, thin, thin * (n % 2 ? thin : size)));
        break;
      case PointShape::kNearSphere:
        p = p.normalized() * (1 + thin * u());
        break;
      case PointShape::kTriangle:
        p << corner[i % 3][0], corner[i % 3][1], 0;
        break;
      case PointShape::kLattice:
        for (double& c : p) c = std::round(3 * c) / 4;
        break;
      case PointShape::kMixedMagnitudes:
        for (double& c : p) c *= std::pow(10.0, -random.uniform(0, 40));
        break;
      case PointShape::kAxis:
        for (int c = 0; c < 3; ++c) p[c] = c == i % 3 ? std::round(p[c]) : std::copysign(0.0, p[c]);
        break;
    }
  }
  return points;
}

/// Returns it turned at random or not, shifted by `offset` sizes, scaled and rounded to S.
template <typename S>
Points<S> place(Random& random, const Points<double>& points, double offset, double scale) {
  const fcl::Matrix3d R =
      random.unit() < 0.3 ? fcl::Matrix3d::Identity().eval() : randomRotation(random);
  const fcl::Vector3d shift =
      offset * (random.unit() < 0.5 ? randomDirection(random) : R.row(0).transpose().eval());
  Points<S> placed;
  for (const fcl::Vector3d& p : points) {
    placed.push_back(((R * p + shift) * scale).template cast<S>());
  }
  return placed;
}

/// Returns sizes for which bounds are promised, the ordinary ones more often than the extreme ones.
template <typename S>
double randomScale(Random& random) {
  const bool is_double = sizeof(S) == sizeof(double);
  switch (below(random, 8)) {
    case 0:  // where caps change their units
      return random.uniform(0.4, 4) * (random.unit() < 0.5 ? 0x1p-30 : 0x1p30);
    case 1:
      return std::pow(10.0, random.uniform(-1, 1) * (is_double ? 150 : 18));
    case 2:  // denormals
      return std::ldexp(random.uniform(1, 2), (is_double ? -1020 : -125) - below(random, 54));
    case 3:
      return std::pow(10.0, random.uniform(-12, 12));
    default:
      return std::pow(10.0, random.uniform(-2, 2));
  }
}

/// Returns offsets of up to 1e12 sizes, or none.
inline double randomOffset(Random& random) {
  return random.unit() < 0.5 ? 0 : std::pow(10.0, random.uniform(-1, 12));
}

/// Returns 1 to about 60 points, triangles (3) and pairs of triangles (6) most often.
inline int randomCount(Random& random) {
  const int kind = below(random, 10);
  return kind < 3 ? 3 : kind < 4 ? 6 : kind < 9 ? 1 + below(random, 16) : 1 + below(random, 60);
}

/// Returns any shape at any place and scale.
template <typename S>
Points<S> hardPointSet(Random& random, int n) {
  const auto shape = static_cast<PointShape>(below(random, kPointShapes));
  const Points<double> points = shapePoints(random, shape, n);
  const double offset = randomOffset(random), scale = randomScale<S>(random);
  return place<S>(random, points, offset, scale);
}

}  // namespace kios::testing
