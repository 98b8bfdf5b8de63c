// SPDX-FileCopyrightText: 2026 The fcl_kios authors
// SPDX-License-Identifier: BSD-3-Clause
#include "scene_set.h"

#include <algorithm>
#include <limits>

#include <fcl/math/bv/OBBRSS.h>
#include <fcl_kios/fcl_kios.h>

#include "calls.h"
#include "managed_bodies.h"

namespace kios::bench {
namespace {

using Object = fcl::CollisionObjectd;

/// Holds the bodies of a scene as collision objects over BV, at the poses of frame 0.
template <typename BV>
struct SceneObjects {
  std::vector<std::shared_ptr<fcl::BVHModel<BV>>> models;
  std::vector<std::unique_ptr<Object>> objects;
  const scenes::BodyScene& scene;

  explicit SceneObjects(const scenes::BodyScene& from) : scene(from) {
    for (const scenes::Mesh& mesh : from.meshes) models.push_back(scenes::buildModel<BV>(mesh));
    for (int body = 0; body < from.size(); ++body) {
      const auto& X =
          body < from.moving() ? from.frames[0][body] : from.places[body - from.moving()];
      objects.push_back(std::make_unique<Object>(models[from.mesh_of[body]], X));
    }
  }
  void place(int frame) {
    const auto& poses = scene.frames[frame];
    for (std::size_t body = 0; body < poses.size(); ++body) {
      objects[body]->setTransform(poses[body]);
    }
  }
  bool admissible(int a, int b) const {
    if (scene.obstacle[a] && scene.obstacle[b]) return false;
    return !std::binary_search(scene.excluded.begin(), scene.excluded.end(), std::minmax({a, b}));
  }
};

/// Every admissible pair in a loop. If bounded, what is known bounds the search: the best so far,
/// or the margin.
template <typename BV, typename Calls>
class ScenePairs final : public SceneSet {
 public:
  ScenePairs(const scenes::BodyScene& scene, bool bounded) : bounded_(bounded), bodies_(scene) {
    for (int a = 0; a < scene.size(); ++a) {
      for (int b = a + 1; b < scene.size(); ++b) {
        if (bodies_.admissible(a, b)) pairs_.emplace_back(a, b);
      }
    }
  }

  bool serves(SceneQuery query) const override {
    return !(bounded_ && query == SceneQuery::kClearances);
  }
  std::vector<SceneAnswer> answer(SceneQuery query, int frame, double margin) override {
    bodies_.place(frame);
    std::vector<SceneAnswer> answers;
    SceneAnswer closest{-1, -1, std::numeric_limits<double>::max()};
    const fcl::DistanceRequestd request;
    for (const auto& [a, b] : pairs_) {
      fcl::DistanceResultd result;
      if (bounded_) result.min_distance = query == SceneQuery::kClosest ? closest.distance : margin;
      Calls::distance(bodies_.objects[a].get(), bodies_.objects[b].get(), request, result);
      const double distance = result.min_distance;
      if (query == SceneQuery::kClosest) {
        if (distance < closest.distance) closest = {a, b, distance};
      } else if (query == SceneQuery::kClearances || distance < margin) {
        answers.push_back({a, b, distance});
      }
    }
    if (query == SceneQuery::kClosest) answers.push_back(closest);
    return answers;
  }
  long long queried() const override { return static_cast<long long>(pairs_.size()); }

 private:
  bool bounded_;
  SceneObjects<BV> bodies_;
  std::vector<std::pair<int, int>> pairs_;
};

/// Holds FCL's dynamic AABB tree with what its default distance callback does, after the filter.
class FclManager final : public SceneSet {
 public:
  explicit FclManager(const scenes::BodyScene& scene) : bodies_(scene) {
    for (int body = 0; body < scene.size(); ++body) {
      const Object& object = *bodies_.objects[body];
      managed_.add(bodies_.models[scene.mesh_of[body]], object.getTransform(),
                   !scene.obstacle[body]);
    }
    managed_.setup();
  }

  bool serves(SceneQuery query) const override { return query != SceneQuery::kClearances; }
  std::vector<SceneAnswer> answer(SceneQuery query, int frame, double margin) override {
    const auto& poses = bodies_.scene.frames[frame];
    for (std::size_t body = 0; body < poses.size(); ++body) managed_.place(body, poses[body]);
    managed_.update();
    const bool closest = query == SceneQuery::kClosest;
    std::vector<SceneAnswer> answers;
    SceneAnswer best{-1, -1, std::numeric_limits<double>::max()};
    queried_ = 0;
    managed_.distance([&](int a, int b, double& reach) {
      reach = closest ? best.distance : margin;
      if (!bodies_.admissible(a, b)) return false;
      ++queried_;
      fcl::DistanceResultd result;
      result.min_distance = reach;
      FclCalls::distance(managed_.object(a), managed_.object(b), fcl::DistanceRequestd(), result);
      if (result.min_distance >= reach) return false;
      const auto [first, second] = std::minmax({a, b});
      const SceneAnswer found{first, second, result.min_distance};
      if (!closest) {
        answers.push_back(found);
        return false;
      }
      best = found;
      reach = best.distance;
      return reach <= 0;
    });
    if (closest) answers.push_back(best);
    return answers;
  }
  long long queried() const override { return queried_; }

 private:
  SceneObjects<fcl::OBBRSSd> bodies_;
  ManagedBodies managed_;
  long long queried_ = 0;
};

class KiosScene final : public SceneSet {
 public:
  explicit KiosScene(const scenes::BodyScene& scene) : bodies_(scene) {
    for (int body = 0; body < scene.size(); ++body) {
      const auto* const object = bodies_.objects[body].get();
      const Role role = scene.obstacle[body] ? Role::kObstacle : Role::kBody;
      if (body < scene.moving()) {
        query_.add(object, role);
      } else {
        query_.add(object->collisionGeometry(), object->getTransform(), role);
      }
    }
    for (const auto& [a, b] : scene.excluded) query_.exclude(a, b);
  }
  void forget() override { query_.forget(); }

  std::vector<SceneAnswer> answer(SceneQuery query, int frame, double margin) override {
    bodies_.place(frame);
    std::vector<SceneAnswer> answers;
    const auto add = [&answers](const ScenePair<double>& pair) {
      answers.push_back({pair.a, pair.b, pair.distance});
    };
    if (query == SceneQuery::kClosest) {
      if (const auto closest = query_.closestPair()) add(*closest);
    } else if (query != SceneQuery::kClearances) {
      SceneRequest request;
      request.exact = query == SceneQuery::kWithin;
      for (const auto& pair : query_.pairsWithin(margin, request)) add(pair);
    } else {
      for (const auto& pair : query_.clearances()) add(pair);
    }
    return answers;
  }
  long long queried() const override { return query_.counts().queried; }

 private:
  SceneObjects<kIOSd> bodies_;
  SceneDistance<double> query_;
};

}  // namespace

std::unique_ptr<SceneSet> makeKiosScene(const scenes::BodyScene& scene) {
  return std::make_unique<KiosScene>(scene);
}

std::unique_ptr<SceneSet> makeSceneSet(const std::string& name, const scenes::BodyScene& scene) {
  using FclPairs = ScenePairs<fcl::OBBRSSd, FclCalls>;
  using KiosPairs = ScenePairs<kIOSd, KiosCalls>;
  const bool bounded = name == "fcl_obbrss_bounded" || name == "kios_bounded";
  if (name == "fcl_manager") return std::make_unique<FclManager>(scene);
  if (name.rfind("kios_", 0) == 0) return std::make_unique<KiosPairs>(scene, bounded);
  return std::make_unique<FclPairs>(scene, bounded);
}

}  // namespace kios::bench
