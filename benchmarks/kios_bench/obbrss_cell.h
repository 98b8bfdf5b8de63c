// SPDX-FileCopyrightText: 2026 The fcl_kios authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <map>
#include <memory>
#include <string>
#include <vector>

#include "fcl_kios/robot/robot.h"
#include "managed_bodies.h"
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
  };

  const Robot& robot_;
  std::vector<Part> parts_;  // by body
  std::vector<robot::PlacedLink> placed_;
  ManagedBodies bodies_;
};

}  // namespace kios::bench
