// SPDX-FileCopyrightText: 2026 The fcl_kios authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <fcl/broadphase/broadphase_dynamic_AABB_tree.h>

#include <map>
#include <memory>
#include <string>
#include <vector>

#include "fcl_kios/robot/robot.h"
#include "robot_impl.h"

namespace kios::bench {

/// The models that FCL makes of a robot's meshes; cells of the same robot share them.
using ObbrssModels = std::map<const void*, std::shared_ptr<fcl::CollisionGeometryd>>;

/// FCL's dynamic AABB trees over OBBRSS, as MoveIt asks them: the robot against itself and against
/// the world. The trees stand from one configuration to the next, where MoveIt makes those of the
/// robot anew.
class ObbrssCell {
 public:
  /// The robot must stay; paddings are not known here.
  ObbrssCell(const Robot& robot, ObbrssModels& models);

  bool isFree(const Eigen::VectorXd& q);

 private:
  struct Part {
    std::string name;
    int node;
    fcl::Transform3d X;
    fcl::CollisionObjectd object;
  };

  void add(fcl::DynamicAABBTreeCollisionManagerd& manager, const robot::Geometry& geometry,
           const std::string& name, int node, const fcl::Transform3d& X, ObbrssModels& models);
  static bool callback(fcl::CollisionObjectd* a, fcl::CollisionObjectd* b, void* cell);

  const Robot& robot_;
  std::vector<std::unique_ptr<Part>> parts_;
  std::vector<robot::PlacedLink> placed_;
  fcl::DynamicAABBTreeCollisionManagerd moving_, still_;
  bool contact_ = false;
};

}  // namespace kios::bench
