// SPDX-FileCopyrightText: 2026 The fcl_kios authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <vector>

#include <fcl/geometry/collision_geometry.h>
#include "description.h"
#include "fcl_kios/model.h"

namespace kios::robot {

enum class BodyKind { kMesh, kShape, kPlane, kOctree };

/// A collision element of a link, an attached object or an obstacle.
struct Body {
  Geometry geometry;
  std::shared_ptr<const Linkage> measured;  ///< as an Element's
  const Modeld* mesh = nullptr;
  BodyKind kind = BodyKind::kMesh;
  bool meets = true;  ///< false: it isn't occupied
  int entity = -1;    ///< whose it is: a link, then an object
  int element = 0;
  int node = -1;   ///< of the tree, that carries it; -1: an obstacle
  int place = -1;  ///< among those that are carried, or among the obstacles
  fcl::Transform3d X_LB = fcl::Transform3d::Identity();
  double padding = 0;
  /// A box of the content in the body's frame, and the ball about its centre that holds the
  /// content.
  fcl::Vector3d middle = fcl::Vector3d::Zero(), half = fcl::Vector3d::Zero();
  double radius = 0;                               ///< infinite for half-spaces and planes
  fcl::Vector3d middle_L = fcl::Vector3d::Zero();  ///< of the box, from the body's origin
  fcl::Vector3d center = fcl::Vector3d::Zero();    ///< of an obstacle's box, in the world
  std::vector<int> numbers;                        ///< in the linkages of proofs; -1: not there

  void measure();  ///< sets what follows from the geometry
  void put(int to, const fcl::Transform3d& X);
};

}  // namespace kios::robot
