// SPDX-FileCopyrightText: 2026 The fcl_kios authors
// SPDX-License-Identifier: BSD-3-Clause

#pragma once

#include <memory>

#include <fcl/math/bv/OBBRSS.h>
#include <fcl/narrowphase/distance.h>

#include "scenes/mesh.h"
#include "scenes/motions.h"

namespace kios::bench {

/// FCL's distance of two meshes, to find poses by: it is fast at any size, and what it gets wrong
/// moves a pose a little.
class PoseFinder {
 public:
  explicit PoseFinder(const scenes::Mesh& mesh)
      : PoseFinder(scenes::buildModel<fcl::OBBRSSd>(mesh)) {}

  double operator()(const scenes::Frame& frame) {
    a_.setTransform(frame.X_WA);
    b_.setTransform(frame.X_WB);
    fcl::DistanceResultd result;
    fcl::distance(&a_, &b_, fcl::DistanceRequestd(), result);
    return result.min_distance;
  }

 private:
  explicit PoseFinder(const std::shared_ptr<fcl::BVHModel<fcl::OBBRSSd>>& model)
      : a_(model), b_(model) {}

  fcl::CollisionObjectd a_;
  fcl::CollisionObjectd b_;
};

}  // namespace kios::bench
