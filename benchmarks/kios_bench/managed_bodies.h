// SPDX-FileCopyrightText: 2026 The fcl_kios authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <memory>
#include <vector>

#include <fcl/broadphase/broadphase_dynamic_AABB_tree.h>

namespace kios::bench {

/// Bodies in FCL's dynamic AABB trees, one of those that move and one of those that stand still and
/// are never asked about each other. Bodies have their numbers in the order of add().
class ManagedBodies {
 public:
  using Object = fcl::CollisionObjectd;

  void add(const std::shared_ptr<fcl::CollisionGeometryd>& geometry, const fcl::Transform3d& X,
           bool moves = true) {
    objects_.push_back(std::make_unique<Object>(geometry, X));
    const auto id = static_cast<std::intptr_t>(objects_.size() - 1);
    objects_.back()->setUserData(reinterpret_cast<void*>(id));
    (moves ? moving_ : still_).registerObject(objects_.back().get());
  }
  /// To be called when all are added.
  void setup() {
    moving_.setup();
    still_.setup();
  }
  void place(std::size_t body, const fcl::Transform3d& X) {
    objects_[body]->setTransform(X);
    objects_[body]->computeAABB();
  }
  /// To be called when all that move are placed.
  void update() { moving_.update(); }

  const Object* object(int body) const { return objects_[static_cast<std::size_t>(body)].get(); }

  /// Calls visit(a, b) for the pairs whose boxes meet, until it returns true. Returns whether it
  /// did.
  template <typename Visit>
  bool collide(const Visit& visit) {
    Pass<Visit> pass{visit};
    const auto callback = [](Object* a, Object* b, void* data) {
      auto& self = *static_cast<Pass<Visit>*>(data);
      self.done = self.done || self.visit(idOf(a), idOf(b));
      return self.done;
    };
    moving_.collide(&pass, callback);
    if (!pass.done && !still_.empty()) moving_.collide(&still_, &pass, callback);
    return pass.done;
  }

  /// Calls visit(a, b, reach) for the pairs whose boxes are nearer than `reach`, which it sets,
  /// until it returns true.
  template <typename Visit>
  void distance(const Visit& visit) {
    Pass<Visit> pass{visit};
    const auto callback = [](Object* a, Object* b, void* data, double& reach) {
      auto& self = *static_cast<Pass<Visit>*>(data);
      self.done = self.done || self.visit(idOf(a), idOf(b), reach);
      return self.done;
    };
    moving_.distance(&pass, callback);
    if (!pass.done && !still_.empty()) moving_.distance(&still_, &pass, callback);
  }

 private:
  template <typename Visit>
  struct Pass {
    const Visit& visit;
    bool done = false;
  };
  static int idOf(const Object* object) {
    return static_cast<int>(reinterpret_cast<std::intptr_t>(object->getUserData()));
  }

  std::vector<std::unique_ptr<Object>> objects_;
  fcl::DynamicAABBTreeCollisionManagerd moving_, still_;
};

}  // namespace kios::bench
