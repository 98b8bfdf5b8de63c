// SPDX-FileCopyrightText: 2026 The fcl_kios authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <limits>
#include <vector>

#include <fcl/geometry/collision_geometry.h>

#include "scenes/mesh.h"
#include "scenes/motions.h"
#include "shape/solid.h"

namespace kios::bench {

/// Answers by testing every triangle with the shape, or with every occupied cell of an octree that
/// is near enough, by the kernel of one triangle and one shape, which the tests compare with an
/// oracle of their own. The mesh must outlive it.
class ShapeOracle {
 public:
  ShapeOracle(const scenes::Mesh& mesh, const fcl::CollisionGeometryd& geometry);

  /// The mesh is the first of the frame.
  double distance(const scenes::Frame& frame) const;
  /// Triangles that touch the shape, or a cell, and as many of them again as cells; counting ends
  /// at `most`.
  double contacts(const scenes::Frame& frame, double most) const;

 private:
  struct Placed {
    shape::Solid solid;
    fcl::Vector3d center;
    double radius;  ///< of a sphere about it, infinity if not known
  };
  /// Calls visit(solid, triangle) for every pair, in the solid's frame, whose spheres are within
  /// `reach`, nearest solids first, until it returns false. `reach` is read anew at each solid.
  template <typename Visit>
  void visitNear(const scenes::Frame& frame, const double& reach, const Visit& visit) const;

  const scenes::Mesh& mesh_;
  fcl::Vector3d center_;  // of a sphere about the mesh
  double radius_ = 0;
  std::vector<Placed> solids_;
};

}  // namespace kios::bench
