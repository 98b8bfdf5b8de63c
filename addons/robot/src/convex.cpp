// SPDX-FileCopyrightText: 2026 The fcl_kios authors
// SPDX-License-Identifier: BSD-3-Clause
#include "convex.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include <fcl/geometry/shape/box.h>
#include <fcl/geometry/shape/capsule.h>
#include <fcl/geometry/shape/cone.h>
#include <fcl/geometry/shape/convex.h>
#include <fcl/geometry/shape/cylinder.h>
#include <fcl/geometry/shape/ellipsoid.h>
#include <fcl/geometry/shape/sphere.h>
#include "shape/simplex.h"
#include "volume/rounding.h"

namespace kios::robot {
namespace {

using fcl::Vector3d;

constexpr double kEps = std::numeric_limits<double>::epsilon();

/// Returns the point of the rim of a disk across z that lies farthest along n.
Vector3d onRim(const Vector3d& n, double radius, double z) {
  const double length = std::hypot(n.x(), n.y());
  if (!(length > 0)) return {radius, 0, z};
  return {radius * (n.x() / length), radius * (n.y() / length), z};
}

Vector3d supportOf(const fcl::CollisionGeometryd& shape, const Vector3d& n) {
  switch (shape.getNodeType()) {
    case fcl::GEOM_BOX: {
      const Vector3d half = 0.5 * as<fcl::Boxd>(shape).side;
      return {std::copysign(half.x(), n.x()), std::copysign(half.y(), n.y()),
              std::copysign(half.z(), n.z())};
    }
    case fcl::GEOM_CAPSULE:
      return {0, 0, std::copysign(0.5 * as<fcl::Capsuled>(shape).lz, n.z())};
    case fcl::GEOM_CYLINDER: {
      const auto& cylinder = as<fcl::Cylinderd>(shape);
      return onRim(n, cylinder.radius, std::copysign(0.5 * cylinder.lz, n.z()));
    }
    case fcl::GEOM_CONE: {
      const auto& cone = as<fcl::Coned>(shape);
      const Vector3d apex(0, 0, 0.5 * cone.lz), rim = onRim(n, cone.radius, -0.5 * cone.lz);
      return n.dot(apex) >= n.dot(rim) ? apex : rim;
    }
    case fcl::GEOM_ELLIPSOID: {
      const Vector3d radii = as<fcl::Ellipsoidd>(shape).radii, scaled = radii.cwiseProduct(n);
      const double length = scaled.stableNorm();
      if (!(length > 0)) return Vector3d::Zero();
      return radii.cwiseProduct(scaled / length);
    }
    case fcl::GEOM_CONVEX: {
      const auto& points = as<fcl::Convexd>(shape).getVertices();
      const Vector3d* best = &points.front();
      for (const Vector3d& p : points) {
        if (n.dot(p) > n.dot(*best)) best = &p;
      }
      return *best;
    }
    default:
      return Vector3d::Zero();  // a sphere's core
  }
}

}  // namespace

Vector3d Convex::support(const Vector3d& n) const {
  return X_ * supportOf(shape_, X_.linear().transpose() * n);
}

double Convex::margin() const {
  if (shape_.getNodeType() == fcl::GEOM_SPHERE) return as<fcl::Sphered>(shape_).radius;
  if (shape_.getNodeType() == fcl::GEOM_CAPSULE) return as<fcl::Capsuled>(shape_).radius;
  return 0;
}

ConvexDistance convexDistance(const Convex& a, const Convex& b) {
  constexpr int kMostSteps = 256;
  shape::Simplex s;
  double size = 0;
  const auto add = [&](const Vector3d& v) {  // the extreme point of a - b against v
    s.add(a.support(-v), b.support(v));
    size = std::max({size, s.on_a[s.size - 1].lpNorm<1>(), s.on_b[s.size - 1].lpNorm<1>()});
    return size;
  };
  Vector3d v = a.center() - b.center();
  if (v.isZero(0)) v = Vector3d::UnitX();
  add(v);
  size = 0;
  const auto [squared, lower] = shape::descend(s, add, kInfinity, kMostSteps);
  ConvexDistance answer;
  for (int i = 0; i < s.size; ++i) {
    answer.point_a += s.weight[i] * s.on_a[i];
    answer.point_b += s.weight[i] * s.on_b[i];
  }
  const Vector3d apart = answer.point_b - answer.point_a;
  const double core = squared > 0 ? apart.norm() : 0, margins = a.margin() + b.margin();
  // Cores that touch but for rounding are in contact.
  const bool touching = !(core > 16 * kEps * size);
  answer.distance = touching ? 0 : std::max(0.0, core - margins);
  // Supports round by 2^-50 of the coordinates.
  answer.lower = std::max(0.0, lower - margins - 0x1p-46 * (size + margins));
  if (!touching) {
    const Vector3d n = apart / core;
    if (answer.distance > 0) {
      answer.point_a += a.margin() * n;
      answer.point_b -= b.margin() * n;
    } else {  // overlap: a point of both
      const double along = std::min(core, a.margin());
      answer.point_a = answer.point_b = answer.point_a + along * n;
    }
  }
  return answer;
}

ConvexDistance planeDistance(const Vector3d& normal, double offset, bool thin, const Convex& b) {
  const auto side = [&](const Vector3d& n, double at) {
    ConvexDistance answer;
    answer.point_b = b.support(-n) - b.margin() * n;
    const double gap = n.dot(answer.point_b) - at;
    answer.point_a = answer.point_b - gap * n;
    const double size = answer.point_b.lpNorm<1>() + std::abs(at);
    answer.distance = std::max(0.0, gap);
    answer.lower = std::max(0.0, gap - 0x1p-46 * size);
    if (!(gap > 0)) answer.point_a = answer.point_b;
    return answer;
  };
  const ConvexDistance above = side(normal, offset);
  if (!thin || above.distance > 0) return above;
  return side(-normal, -offset);
}

}  // namespace kios::robot
