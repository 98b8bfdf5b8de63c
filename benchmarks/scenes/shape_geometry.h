// SPDX-FileCopyrightText: 2026 The fcl_kios authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <memory>
#include <vector>

#include <fcl/geometry/octree/octree.h>
#include <fcl/geometry/shape/convex.h>

#include "scenes/mesh.h"

namespace kios::scenes {

/// Returns a convex shape with the faces of a mesh that is one.
template <typename S = double>
std::shared_ptr<fcl::CollisionGeometry<S>> convexOf(const Mesh& hull) {
  const auto vertices = std::make_shared<std::vector<fcl::Vector3<S>>>();
  for (const fcl::Vector3d& p : hull.vertices) vertices->push_back(p.template cast<S>());
  const auto faces = std::make_shared<std::vector<int>>();
  for (const fcl::Triangle& t : hull.triangles) {
    faces->push_back(3);
    for (int corner = 0; corner < 3; ++corner) faces->push_back(static_cast<int>(t[corner]));
  }
  return std::make_shared<fcl::Convex<S>>(vertices, static_cast<int>(hull.triangles.size()), faces);
}

/// Returns the cells of this size that hold points are occupied.
inline std::shared_ptr<fcl::CollisionGeometryd> octreeOf(const std::vector<fcl::Vector3d>& points,
                                                         double cell) {
  auto tree = std::make_shared<octomap::OcTree>(cell);
  for (const fcl::Vector3d& p : points) {
    tree->updateNode(octomap::point3d(static_cast<float>(p[0]), static_cast<float>(p[1]),
                                      static_cast<float>(p[2])),
                     true);
  }
  tree->updateInnerOccupancy();
  return std::make_shared<fcl::OcTreed>(std::shared_ptr<const octomap::OcTree>(tree));
}

}  // namespace kios::scenes
