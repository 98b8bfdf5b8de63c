// SPDX-FileCopyrightText: 2026 The fcl_kios authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <map>
#include <memory>
#include <string>

#include <fcl/geometry/octree/octree.h>

#include "fcl/mesh_cases.h"
#include "shape/shape_oracle.h"

namespace kios::testing {

using Geometry = std::shared_ptr<fcl::CollisionGeometryd>;

/// Returns a geometry of every kind that a mesh over k-IOS may meet, by name, all about the origin
/// and of size 1: the nine shapes, a mesh and an octree.
inline std::map<std::string, Geometry> partners() {
  std::map<std::string, Geometry> all;
  scenes::Random random(3);
  for (const Shape kind : kShapes) all[nameOf(kind)] = makeShape<double>(randomShape(kind, random));
  all["mesh"] = kiosModel(scenes::icosphere(0.6, 2));
  const auto cells = std::make_shared<octomap::OcTree>(0.25);
  // Occupied beyond doubt.
  for (int i = 0; i < 8; ++i) cells->updateNode(octomap::point3d(0.1F, 0.3F, 0.1F), true);
  all["octree"] = std::make_shared<fcl::OcTreed>(cells);
  return all;
}

}  // namespace kios::testing
