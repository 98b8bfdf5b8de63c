// SPDX-FileCopyrightText: 2026 The fcl_kios authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <functional>
#include <memory>
#include <string>

#include <fcl/math/motion/motion_base.h>
#include <fcl/narrowphase/continuous_collision_result.h>

#include "report.h"
#include "scenes/mesh.h"

namespace kios::bench {

/// Both meshes on their way, from t = 0 to 1.
struct Motions {
  std::shared_ptr<fcl::MotionBased> a, b;
};

/// Holds a way to find the first contact in time of two models.
struct Way {
  std::string name;
  double time_error;
  bool splines;  // whether it serves them
  /// Adds its work, where it is counted.
  std::function<fcl::ContinuousCollisionResultd(const Motions& motions, Tests* work)> answer;
};

/// Ours, under this name.
Way kiosWay(const std::string& name, const scenes::Mesh& a, const scenes::Mesh& b);

}  // namespace kios::bench
