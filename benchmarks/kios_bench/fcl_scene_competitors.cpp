// SPDX-FileCopyrightText: 2026 The fcl_kios authors
// SPDX-License-Identifier: BSD-3-Clause

// FCL's own functions: this file must not see the overloads of our header.

#include <unordered_map>

#include <fcl/broadphase/broadphase_dynamic_AABB_tree.h>
#include <fcl/math/bv/OBBRSS.h>
#include <fcl/narrowphase/distance.h>

#include "scene_pairs.h"

namespace kios::bench {
namespace {

using Object = fcl::CollisionObjectd;

struct FclDistance {
  static void ask(const Object* a, const Object* b, const fcl::DistanceRequestd& request,
                  fcl::DistanceResultd& result) {
    fcl::distance(a, b, request, result);
  }
};

/// FCL's dynamic AABB tree with what its default distance callback does, after the filter. Bodies
/// that stand still are in a manager of their own, and never asked about each other.
class FclManager final : public SceneCompetitor {
 public:
  const char* name() const override { return "fcl_manager"; }
  bool serves(SceneQuery query) const override { return query != SceneQuery::kClearances; }

  void load(const scenes::BodyScene& scene) override {
    bodies_.load(scene);
    for (int body = 0; body < scene.size(); ++body) {
      Object* const object = bodies_.objects[body].get();
      object->setUserData(reinterpret_cast<void*>(static_cast<std::intptr_t>(body)));
      object->computeAABB();
      (scene.obstacle[body] ? still_ : moving_).registerObject(object);
    }
    moving_.setup();
    still_.setup();
  }

  std::vector<SceneAnswer> answer(SceneQuery query, int frame, double margin) override {
    bodies_.place(frame);
    for (int body = 0; body < bodies_.scene->moving(); ++body) bodies_.objects[body]->computeAABB();
    moving_.update();
    query_ = query;
    margin_ = margin;
    queried_ = 0;
    answers_.clear();
    closest_ = {-1, -1, std::numeric_limits<double>::max()};
    moving_.distance(this, &FclManager::callback);
    if (!still_.empty() && !done_()) moving_.distance(&still_, this, &FclManager::callback);
    if (query == SceneQuery::kClosest) answers_.push_back(closest_);
    return answers_;
  }
  long long queried() const override { return queried_; }
  std::size_t bytes() const override { return bodies_.bytes(); }

 private:
  static int idOf(const Object* object) {
    return static_cast<int>(reinterpret_cast<std::intptr_t>(object->getUserData()));
  }
  bool done_() const { return query_ == SceneQuery::kClosest && closest_.distance <= 0; }

  static bool callback(Object* o1, Object* o2, void* data, double& dist) {
    FclManager& self = *static_cast<FclManager*>(data);
    const auto [a, b] = std::minmax({idOf(o1), idOf(o2)});
    const bool closest = self.query_ == SceneQuery::kClosest;
    dist = closest ? self.closest_.distance : self.margin_;
    if (self.done_()) return true;
    if (!self.bodies_.admissible(a, b)) return false;
    ++self.queried_;
    fcl::DistanceResultd result;
    result.min_distance = dist;
    fcl::distance(self.bodies_.objects[a].get(), self.bodies_.objects[b].get(),
                  fcl::DistanceRequestd(), result);
    if (result.min_distance < dist) {
      if (closest) {
        self.closest_ = {a, b, result.min_distance};
        dist = result.min_distance;
      } else {
        self.answers_.push_back({a, b, result.min_distance});
      }
    }
    return self.done_();
  }

  SceneObjects<fcl::OBBRSSd> bodies_;
  fcl::DynamicAABBTreeCollisionManagerd moving_, still_;
  SceneQuery query_ = SceneQuery::kClosest;
  double margin_ = 0;
  long long queried_ = 0;
  SceneAnswer closest_{-1, -1, 0};
  std::vector<SceneAnswer> answers_;
};

}  // namespace

std::unique_ptr<SceneCompetitor> makeFclPairs() {
  return std::make_unique<ScenePairs<fcl::OBBRSSd, FclDistance>>("fcl_obbrss", false);
}

std::unique_ptr<SceneCompetitor> makeFclBoundedPairs() {
  return std::make_unique<ScenePairs<fcl::OBBRSSd, FclDistance>>("fcl_obbrss_bounded", true);
}

std::unique_ptr<SceneCompetitor> makeFclManager() { return std::make_unique<FclManager>(); }

}  // namespace kios::bench
