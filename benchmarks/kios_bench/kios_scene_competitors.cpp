// SPDX-FileCopyrightText: 2026 The fcl_kios authors
// SPDX-License-Identifier: BSD-3-Clause

#include <fcl_kios/fcl_kios.h>
#include <fcl_kios/scene/scene_distance.h>

#include "scene_pairs.h"

namespace kios::bench {
namespace {

struct KiosDistance {
  static void ask(const fcl::CollisionObjectd* a, const fcl::CollisionObjectd* b,
                  const fcl::DistanceRequestd& request, fcl::DistanceResultd& result) {
    fcl::distance(a, b, request, result);
  }
};

class KiosScene final : public SceneCompetitor {
 public:
  const char* name() const override { return "kios"; }
  bool serves(SceneQuery /*query*/) const override { return true; }

  void load(const scenes::BodyScene& scene) override {
    bodies_.load(scene);
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
  std::size_t bytes() const override {
    std::size_t sum = bodies_.bytes();
    for (const auto& model : bodies_.models) sum += preparedBytes(*model);
    return sum;
  }
  std::optional<std::size_t> preparedModels() const override {
    std::size_t prepared = 0;
    for (const auto& model : bodies_.models) prepared += preparedBytes(*model) > 0 ? 1 : 0;
    return prepared;
  }
  std::optional<std::string> simdTarget() const override { return kios::simdTarget(); }

 private:
  SceneObjects<kIOSd> bodies_;
  SceneDistance<double> query_;
};

}  // namespace

std::unique_ptr<SceneCompetitor> makeKiosPairs(bool bounded) {
  return std::make_unique<ScenePairs<kIOSd, KiosDistance>>(bounded ? "kios_bounded" : "kios_pairs",
                                                           bounded);
}

std::unique_ptr<SceneCompetitor> makeKiosScene() { return std::make_unique<KiosScene>(); }

}  // namespace kios::bench
