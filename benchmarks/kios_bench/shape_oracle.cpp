// SPDX-FileCopyrightText: 2026 The fcl_kios authors
// SPDX-License-Identifier: BSD-3-Clause
#include "shape_oracle.h"

#include <algorithm>

#include <fcl/geometry/octree/octree.h>
#include <fcl/geometry/shape/box.h>

#include "shape/shape_solid.h"
#include "shape/triangle_shape.h"

namespace kios::bench {

ShapeOracle::ShapeOracle(const scenes::Mesh& mesh, const fcl::CollisionGeometryd& geometry)
    : mesh_(mesh), center_(fcl::Vector3d::Zero()) {
  for (const fcl::Vector3d& p : mesh.vertices) {
    center_ += p / static_cast<double>(mesh.vertices.size());
  }
  for (const fcl::Vector3d& p : mesh.vertices) radius_ = std::max(radius_, (p - center_).norm());
  if (geometry.getObjectType() != fcl::OT_OCTREE) {
    solids_.push_back(
        {toSolid(geometry), fcl::Vector3d::Zero(), std::numeric_limits<double>::infinity()});
    return;
  }
  for (const auto& [x, y, z, size, occupancy, threshold] :
       static_cast<const fcl::OcTreed&>(geometry).toBoxes()) {
    solids_.push_back({toSolid<double>(fcl::Boxd(size, size, size)), {x, y, z}, 0.87 * size});
  }
}

template <typename Visit>
void ShapeOracle::visitNear(const scenes::Frame& frame, const double& reach,
                            const Visit& visit) const {
  const fcl::Matrix3d R = frame.X_WB.linear().transpose() * frame.X_WA.linear();
  const fcl::Vector3d t =
      frame.X_WB.linear().transpose() * (frame.X_WA.translation() - frame.X_WB.translation());
  std::vector<shape::Triangle> triangles(mesh_.triangles.size());
  for (std::size_t i = 0; i < triangles.size(); ++i) {
    for (int c = 0; c < 3; ++c) triangles[i][c] = R * mesh_.vertices[mesh_.triangles[i][c]] + t;
  }
  const fcl::Vector3d center = R * center_ + t;
  std::vector<std::pair<double, const Placed*>> order;  // lower bounds
  for (const Placed& placed : solids_) {
    order.emplace_back((placed.center - center).norm() - radius_ - placed.radius, &placed);
  }
  std::sort(order.begin(), order.end());
  for (const auto& [bound, placed] : order) {
    if (bound > reach) return;
    for (const shape::Triangle& triangle : triangles) {
      const double extent =
          std::max((triangle[1] - triangle[0]).norm(), (triangle[2] - triangle[0]).norm());
      if ((triangle[0] - placed->center).norm() - extent - placed->radius > reach) continue;
      shape::Triangle local = triangle;
      for (shape::Vec& corner : local) corner -= placed->center;
      if (!visit(placed->solid, local)) return;
    }
  }
}

double ShapeOracle::distance(const scenes::Frame& frame) const {
  double nearest = std::numeric_limits<double>::infinity();
  visitNear(frame, nearest, [&](const shape::Solid& solid, const shape::Triangle& triangle) {
    nearest = std::min(nearest, shape::distance(solid, triangle, nearest).distance);
    return nearest > 0;
  });
  return nearest;
}

double ShapeOracle::contacts(const scenes::Frame& frame, double most) const {
  double contacts = 0;
  const double reach = 0;
  visitNear(frame, reach, [&](const shape::Solid& solid, const shape::Triangle& triangle) {
    if (shape::intersects(solid, triangle)) contacts += 1;
    return contacts < most;
  });
  return contacts;
}

}  // namespace kios::bench
