// SPDX-FileCopyrightText: 2026 The fcl_kios authors
// SPDX-License-Identifier: BSD-3-Clause
#include "body.h"

#include <algorithm>
#include <cmath>

#include <fcl/config.h>
#include <fcl/geometry/shape/box.h>
#include <fcl/geometry/shape/capsule.h>
#include <fcl/geometry/shape/cone.h>
#include <fcl/geometry/shape/convex.h>
#include <fcl/geometry/shape/cylinder.h>
#include <fcl/geometry/shape/ellipsoid.h>
#include <fcl/geometry/shape/sphere.h>
#if FCL_HAVE_OCTOMAP
#include <fcl/geometry/octree/octree.h>
#endif
#include "convex.h"
#include "volume/rounding.h"

namespace kios::robot {
namespace {

using fcl::Vector3d;

/// The box of a list of points, and the largest distance from its middle.
template <typename Points>
void bound(const Points& points, int count, Body& body) {
  Vector3d low = Vector3d::Constant(kInfinity), high = -low;
  for (int i = 0; i < count; ++i) {
    low = low.cwiseMin(points[i]);
    high = high.cwiseMax(points[i]);
  }
  body.middle = low + 0.5 * (high - low);
  body.half = (high - body.middle).cwiseMax(body.middle - low);
  double square = 0;
  for (int i = 0; i < count; ++i)
    square = std::max(square, (points[i] - body.middle).squaredNorm());
  body.radius = std::sqrt(square);
}

}  // namespace

void Body::measure() {
  const fcl::CollisionGeometryd& g = *geometry;
  meets = g.isOccupied();
  const auto round = [&](double x, double y, double z) { half = Vector3d(x, y, z); };
  switch (g.getNodeType()) {
    case fcl::GEOM_HALFSPACE:
    case fcl::GEOM_PLANE:
      kind = BodyKind::kPlane;
      radius = kInfinity;
      half.setConstant(kInfinity);
      return;
    case fcl::GEOM_BOX:
      half = 0.5 * as<fcl::Boxd>(g).side;
      radius = half.norm();
      break;
    case fcl::GEOM_SPHERE:
      radius = as<fcl::Sphered>(g).radius;
      round(radius, radius, radius);
      break;
    case fcl::GEOM_CAPSULE: {
      const auto& s = as<fcl::Capsuled>(g);
      round(s.radius, s.radius, 0.5 * s.lz + s.radius);
      radius = 0.5 * s.lz + s.radius;
      break;
    }
    case fcl::GEOM_CYLINDER: {
      const auto& s = as<fcl::Cylinderd>(g);
      round(s.radius, s.radius, 0.5 * s.lz);
      radius = std::hypot(s.radius, 0.5 * s.lz);
      break;
    }
    case fcl::GEOM_CONE: {
      const auto& s = as<fcl::Coned>(g);
      round(s.radius, s.radius, 0.5 * s.lz);
      radius = std::hypot(s.radius, 0.5 * s.lz);
      break;
    }
    case fcl::GEOM_ELLIPSOID:
      half = as<fcl::Ellipsoidd>(g).radii;
      radius = half.maxCoeff();
      break;
    case fcl::GEOM_CONVEX: {
      const auto& points = as<fcl::Convexd>(g).getVertices();
      bound(points, static_cast<int>(points.size()), *this);
      break;
    }
#if FCL_HAVE_OCTOMAP
    case fcl::GEOM_OCTREE: {
      const auto box = as<fcl::OcTreed>(g).getRootBV();
      middle = 0.5 * (box.min_ + box.max_);
      half = 0.5 * (box.max_ - box.min_);
      radius = half.norm();
      kind = BodyKind::kOctree;
      break;
    }
#endif
    default:
      mesh = static_cast<const Modeld*>(geometry.get());  // a linkage took it
      bound(mesh->vertices, mesh->num_vertices, *this);
  }
  if (mesh == nullptr && kind != BodyKind::kOctree) kind = BodyKind::kShape;
  // More than all that rounds here and where the ball and the box are asked.
  const double slack = 0x1p-40 * (middle.norm() + radius);
  radius += slack;
  half.array() += slack;
}

void Body::put(int to, const fcl::Transform3d& X) {
  node = to;
  X_LB = X;
  middle_L = X.linear() * middle;
  center = X * middle;
}

}  // namespace kios::robot
