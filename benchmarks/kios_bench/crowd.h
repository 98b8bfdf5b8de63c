// SPDX-FileCopyrightText: 2026 The fcl_kios authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <memory>
#include <string>
#include <utility>
#include <vector>

#include <fcl/broadphase/broadphase_dynamic_AABB_tree.h>

#include "calls.h"
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
  virtual std::string name() const = 0;
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
  using Object = fcl::CollisionObjectd;

 public:
  explicit CrowdOf(std::string name) : name_(std::move(name)) {}
  std::string name() const override { return name_; }

  void make(const std::vector<scenes::Mesh>& meshes,
            const std::vector<fcl::Transform3d>& poses) override {
    manager_ = std::make_unique<fcl::DynamicAABBTreeCollisionManagerd>();
    objects_.clear();
    for (std::size_t i = 0; i < meshes.size(); ++i) {
      objects_.emplace_back(scenes::buildModel<BV>(meshes[i]), poses[i]);
    }
    for (Object& object : objects_) manager_->registerObject(&object);
    manager_->setup();
  }

  void collide(std::vector<BodyPair>& pairs) override {
    struct Pass {
      const Object* first;
      std::vector<BodyPair>& pairs;
    } pass{objects_.data(), pairs};
    pairs.clear();
    manager_->collide(&pass, [](Object* a, Object* b, void* data) {
      Pass& to = *static_cast<Pass*>(data);
      const fcl::CollisionRequestd request;
      fcl::CollisionResultd result;
      Calls::collide(a, b, request, result);
      to.pairs.push_back(
          {static_cast<int>(a - to.first), static_cast<int>(b - to.first), result.isCollision()});
      return false;
    });
  }

  double distance() override {
    fcl::DistanceResultd result;
    manager_->distance(&result, [](Object* a, Object* b, void* data, double& distance) {
      fcl::DistanceResultd& least = *static_cast<fcl::DistanceResultd*>(data);
      const fcl::DistanceRequestd request;
      distance = least.min_distance;
      if (distance <= 0) return true;
      Calls::distance(a, b, request, least);
      distance = least.min_distance;
      return distance <= 0;
    });
    return result.min_distance;
  }

 private:
  std::string name_;
  std::vector<Object> objects_;
  std::unique_ptr<fcl::DynamicAABBTreeCollisionManagerd> manager_;
};

}  // namespace kios::bench
