// SPDX-FileCopyrightText: 2026 The fcl_kios authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <memory>
#include <vector>

#include "calls.h"
#include "managed_bodies.h"
#include "scenes/mesh.h"

namespace kios::bench {

struct BodyPair {
  int a, b;
  bool hit;
};

/// Bodies in FCL's manager.
class Crowd {
 public:
  virtual ~Crowd() = default;
  /// Makes models that share nothing with those before, and a manager for them.
  virtual void make(const std::vector<scenes::Mesh>& meshes,
                    const std::vector<fcl::Transform3d>& poses) = 0;
  /// Every pair that the manager brings, first contact.
  virtual void collide(std::vector<BodyPair>& pairs) = 0;
  /// Returns the least distance.
  virtual double distance() = 0;
};

template <typename BV, typename Calls>
class CrowdOf final : public Crowd {
 public:
  void make(const std::vector<scenes::Mesh>& meshes,
            const std::vector<fcl::Transform3d>& poses) override {
    bodies_ = std::make_unique<ManagedBodies>();
    for (std::size_t i = 0; i < meshes.size(); ++i) {
      bodies_->add(scenes::buildModel<BV>(meshes[i]), poses[i]);
    }
    bodies_->setup();
  }

  void collide(std::vector<BodyPair>& pairs) override {
    pairs.clear();
    bodies_->collide([&](int a, int b) {
      const fcl::CollisionRequestd request;
      fcl::CollisionResultd result;
      Calls::collide(bodies_->object(a), bodies_->object(b), request, result);
      pairs.push_back({a, b, result.isCollision()});
      return false;
    });
  }

  double distance() override {
    fcl::DistanceResultd least;
    bodies_->distance([&](int a, int b, double& reach) {
      const fcl::DistanceRequestd request;
      Calls::distance(bodies_->object(a), bodies_->object(b), request, least);
      reach = least.min_distance;
      return reach <= 0;
    });
    return least.min_distance;
  }

 private:
  std::unique_ptr<ManagedBodies> bodies_;
};

}  // namespace kios::bench
