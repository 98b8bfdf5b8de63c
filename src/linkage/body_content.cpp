// SPDX-FileCopyrightText: 2026 The fcl_kios authors
// SPDX-License-Identifier: BSD-3-Clause
#include "linkage/body_content.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include <fcl/config.h>
#if FCL_HAVE_OCTOMAP
#include <fcl/geometry/octree/octree.h>
#endif
#include "model/kios_model.h"
#include "model/shape_values.h"
#include "shape/shape_solid.h"
#include "shape/simplex.h"
#include "volume/errors.h"

namespace kios::articulated {
namespace {

using Eigen::Vector3d;

/// Points whose hull, grown by `margin`, contains a geometry, in its frame.
struct Hull {
  std::vector<Vector3d> points;
  double margin = 0;
  Vector3d center = Vector3d::Zero();
};

void addBox(const Vector3d& low, const Vector3d& high, std::vector<Vector3d>& points) {
  for (int i = 0; i < 8; ++i) {
    points.emplace_back((i & 1) != 0 ? high.x() : low.x(), (i & 2) != 0 ? high.y() : low.y(),
                        (i & 4) != 0 ? high.z() : low.z());
  }
}

/// Cylinders and cones lie in prisms of eight sides: 1 / cos(pi / 8) < 1.0824.
void addPrism(double radius, double half_length, std::vector<Vector3d>& points) {
  constexpr double kEighth = 0.7853981633974483;
  for (int i = 0; i < 8; ++i) {
    const double x = 1.0824 * radius * std::cos(i * kEighth);
    const double y = 1.0824 * radius * std::sin(i * kEighth);
    points.emplace_back(x, y, -half_length);
    points.emplace_back(x, y, half_length);
  }
}

Hull hullOf(const shape::Solid& solid) {
  using shape::Kind;
  Hull hull;
  hull.margin = solid.margin();
  if (!solid.bounded()) {
    hull.points = {solid.offset * solid.normal};
    return hull;
  }
  const auto [low, high] = shape::rangeOf(solid);
  hull.center = 0.5 * (low + high);
  if (solid.kind == Kind::kConvex) {
    hull.points = solid.points;
  } else if (solid.kind == Kind::kCylinder || solid.kind == Kind::kCone) {
    addPrism(solid.radius, solid.half_length, hull.points);
  } else {
    addBox(low, high, hull.points);
  }
  return hull;
}

Hull hullOf(const Modeld& model) {
  Hull hull;
  std::vector<char> taken(static_cast<std::size_t>(model.num_vertices), 0);
  hull.points.reserve(taken.size());
  for (int i = 0; i < model.num_tris; ++i) {
    for (int k = 0; k < 3; ++k) {
      const std::size_t vertex = model.tri_indices[i][k];
      if (taken[vertex] == 0) hull.points.push_back(model.vertices[vertex]);
      taken[vertex] = 1;
    }
  }
  hull.center = model.getBV(0).bv.center0;
  return hull;
}

#if FCL_HAVE_OCTOMAP
/// The box of the occupied cells; no points if there are none. Cells have their places by two sums
/// in octomap and in FCL, which differ by rounding.
Hull hullOf(const fcl::OcTreed& octree, const Eigen::AlignedBox3d& cells) {
  Hull hull;
  if (cells.isEmpty()) return hull;
  addBox(cells.min(), cells.max(), hull.points);
  hull.center = cells.center();
  hull.margin = 0x1p-40 * octree.getRootBV().max_.lpNorm<1>();
  return hull;
}
#endif

Hull measure(Content& body) {
  const fcl::CollisionGeometryd& geometry = *body.geometry;
  if (const Modeld* const model = asModel(&geometry)) {
    requireFinished(*model);
    body.kind = BodyKind::kMesh;
    body.model = model;
    body.state = stateOf(*model);
    return hullOf(*model);
  }
  if (isShape(geometry)) {
    body.kind = BodyKind::kShape;
    body.solid = toSolid(geometry);
    shape::makeRows(body.solid);
    body.shape_values = shapeValues(geometry);
    body.bounded = body.solid.bounded();
    return hullOf(body.solid);
  }
#if FCL_HAVE_OCTOMAP
  if (geometry.getObjectType() == fcl::OT_OCTREE) {
    const auto& octree = static_cast<const fcl::OcTreed&>(geometry);
    body.kind = BodyKind::kOctree;
    body.cells = continuous::occupiedBox(octree);
    return hullOf(octree, body.cells);
  }
#endif
  const bool mesh = geometry.getObjectType() == fcl::OT_BVH;
  refuse("a body of a linkage can't be a ", typeName(geometry),
         mesh ? "; convert it by kios::toKIOS(model)."
              : "; replace it by a mesh, built by kios::makeModel().");
}

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

}  // namespace

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
    const Vector3d a = bound.ends[0] - p, b = bound.ends[1] - p;
    radius = std::max(radius, (a + shape::nearestOnSegment(a, b) * (b - a)).norm());
  }
  bound.capsule_radius = grown(radius + margin, 4 * size);
  return bound;
}

double ContentBound::reach() const {
  const double ball = center.norm() + radius;
  const double capsule = std::max(ends[0].norm(), ends[1].norm()) + capsule_radius;
  return std::min(ball, capsule) * (1 + 0x1p-48);
}

Content::Content(std::shared_ptr<const fcl::CollisionGeometryd> of) : geometry(std::move(of)) {
  if (!geometry) refuse("the geometry of a body of a linkage is null.");
  Hull hull = measure(*this);
  occupied = geometry->isOccupied();
  meets = occupied && !hull.points.empty();
  if (hull.points.empty()) hull.points.push_back(hull.center);
  for (const Vector3d& p : hull.points) size = std::max(size, p.lpNorm<1>());
  size += hull.margin + hull.center.lpNorm<1>();
  constexpr double kLargest = 0x1p300;  // so that no product overflows
  if (!(size <= kLargest)) refuse("a body of a linkage is too large.");
  content = boundOf(hull.points, hull.margin, hull.center);
  if (bounded) supports = SupportTable(hull.points, hull.margin);
}

// A point rounds by less than 8 u of the lengths, and the rotation stretches by 8 u.
ContentBound placed(const Content& body, const fcl::Transform3d& X) {
  ContentBound bound = body.content;
  const double slack = 0x1p-48 * (body.size + X.translation().norm());
  bound.center = X * bound.center;
  bound.radius += slack;
  for (Vector3d& end : bound.ends) end = X * end;
  bound.capsule_radius += 4 * slack;  // ends are twice as far as the content at most
  return bound;
}

}  // namespace kios::articulated
