// SPDX-FileCopyrightText: 2026 The fcl_kios authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <gtest/gtest.h>

#include <map>
#include <optional>
#include <set>
#include <utility>
#include <vector>

#include "fcl_kios/scene.h"
#include "model/deform.h"
#include "scenes/cad_shapes.h"
#include "scenes/random.h"

// A scene that changes at random, and what brute force says of it.

namespace kios::testing {

/// Holds the spread of a scene's objects, their size, and their place in the world.
struct SceneSettings {
  int objects = 8;
  double spread = 2;
  Vector3d offset = Vector3d::Zero();
  bool shapes = false;  ///< geometries of FCL as well
  bool obstacles = false;
};

class RandomScene {
 public:
  struct Object {
    std::shared_ptr<fcl::CollisionGeometryd> geometry;
    std::shared_ptr<Modeld> model;  ///< the same, if it is one
    Mesh mesh;
    Transform3d X_W;
    Role role = Role::kBody;
    std::unique_ptr<fcl::CollisionObjectd> followed;
  };

  RandomScene(const SceneSettings& settings, std::uint64_t seed)
      : settings_(settings), random_(seed) {
    const Mesh torus = scenes::bumpyTorus(100);
    meshes_ = {
        scenes::icosphere(0.5, 1),
        torus,
        scenes::sheet(1, 1, 3, 3, 0.2),
        scenes::randomSoup(12, 0.5, 0.05, 0.5, 9),
        scenes::singleTriangle({0, 0, 0}, {0.3, 0, 0}, {0, 0.2, 0.1}),
        scenes::subdividedBox({1, 0.4, 0.2}, 2),
        scenes::moved(Transform3d(Eigen::Translation3d(30, 5, -7)), scenes::icosphere(0.3, 1))};
    for (int i = 0; i < settings.objects; ++i) add();
  }

  SceneDistance<double>& scene() { return scene_; }
  const std::map<int, Object>& objects() const { return objects_; }
  scenes::Random& random() { return random_; }

  /// One frame: some objects move a little, others jump, come, go, deform, are excluded.
  void change() {
    if (random_.unit() < 0.1) return;  // all stand still
    const double how = random_.unit();
    if (how < 0.1) {  // everything moves alike
      const Transform3d X = step(random_.unit() < 0.5 ? 0.01 : 1);
      for (auto& [id, object] : objects_) moveTo(id, X * object.X_W);
    } else {
      const double moving = random_.unit();
      const double size = std::pow(10, random_.uniform(-12, 0));
      for (auto& [id, object] : objects_) {
        if (random_.unit() < moving) moveTo(id, object.X_W * step(size));
      }
    }
    if (random_.unit() < 0.1) moveTo(anyId(), anyPose());
    if (random_.unit() < 0.02) moveTo(anyId(), Transform3d(Eigen::Translation3d(1e12, 0, 0)));
    if (random_.unit() < 0.1 && objects_.size() > 2) remove(anyId());
    if (random_.unit() < 0.1 && static_cast<int>(objects_.size()) < settings_.objects + 3) add();
    if (random_.unit() < 0.1) deform(anyId());
    if (random_.unit() < 0.2) toggle(anyId(), anyId());
    if (random_.unit() < 0.05) changeFilter();
  }

  bool admissible(int a, int b) const {
    if (objects_.at(a).role == Role::kObstacle && objects_.at(b).role == Role::kObstacle) {
      return false;
    }
    return excluded_.count({a, b}) == 0 && (filter_ == 0 || (a + b) % filter_ != 0);
  }

  /// fcl::distance of every admissible pair, by ids.
  std::map<std::pair<int, int>, fcl::DistanceResultd> bruteForce() const {
    std::map<std::pair<int, int>, fcl::DistanceResultd> distances;
    for (const auto& [a, object_a] : objects_) {
      for (const auto& [b, object_b] : objects_) {
        if (!(a < b) || !admissible(a, b)) continue;
        fcl::DistanceResultd result;
        const double distance =
            fcl::distance(object_a.geometry.get(), object_a.X_W, object_b.geometry.get(),
                          object_b.X_W, fcl::DistanceRequestd(true), result);
        result.min_distance = distance;
        distances[{a, b}] = result;
      }
    }
    return distances;
  }

  void moveTo(int id, const Transform3d& X_W) {
    Object& object = objects_.at(id);
    object.X_W = X_W;
    if (object.followed) {
      object.followed->setTransform(X_W);
    } else {
      scene_.move(id, X_W);
    }
  }

 private:
  int anyId() {
    auto it = objects_.begin();
    std::advance(it, static_cast<int>(random_.unit() * static_cast<double>(objects_.size())));
    return it->first;
  }

  Transform3d anyPose() {
    Transform3d X = scenes::randomPoses(1, settings_.spread,
                                        static_cast<std::uint64_t>(random_.unit() * 1e9))[0];
    X.translation() += settings_.offset;
    return X;
  }

  Transform3d step(double size) {
    const auto u = [&] { return random_.uniform(-1, 1); };
    const Vector3d shift(u(), u(), u()), axis(u(), u(), u());
    Transform3d X = Transform3d::Identity();
    if (random_.unit() < 0.8) X.translation() = size * shift;
    if (random_.unit() < 0.8) X.linear() = fcl::AngleAxisd(size * u(), axis.normalized()).matrix();
    return X;
  }

  void add() {
    Object object;
    object.X_W = anyPose();
    if (settings_.obstacles && random_.unit() < 0.5) object.role = Role::kObstacle;
    if (settings_.shapes && random_.unit() < 0.4) {
      object.geometry = std::make_shared<fcl::Sphered>(random_.uniform(0.1, 0.5));
    } else {
      object.mesh = meshes_[static_cast<int>(random_.unit() * static_cast<double>(meshes_.size()))];
      object.model = kiosModel(object.mesh);
      object.geometry = object.model;
    }
    int id = -1;
    if (random_.unit() < 0.5) {
      object.followed = std::make_unique<fcl::CollisionObjectd>(object.geometry, object.X_W);
      id = scene_.add(object.followed.get(), object.role);
    } else {
      id = scene_.add(object.geometry, object.X_W, object.role);
    }
    ASSERT_EQ(objects_.count(id), 0u);
    objects_.emplace(id, std::move(object));
  }

  void remove(int id) {
    scene_.remove(id);
    objects_.erase(id);
    for (auto it = excluded_.begin(); it != excluded_.end();) {
      it = it->first == id || it->second == id ? excluded_.erase(it) : std::next(it);
    }
  }

  void deform(int id) {
    Object& object = objects_.at(id);
    if (!object.model) return;
    const auto vertices = swayed(object.mesh, random_.uniform(0, 6));
    const bool refit = random_.unit() < 0.5, bottomup = random_.unit() < 0.5;
    if (object.model->build_state != fcl::BVH_BUILD_STATE_UPDATED && random_.unit() < 0.5) {
      replace(*object.model, vertices, refit, bottomup);
    } else {
      update(*object.model, vertices, refit, bottomup);
    }
  }

  void toggle(int a, int b) {
    if (a == b) return;
    const auto [low, high] = std::minmax({a, b});
    const bool exclude = excluded_.insert({low, high}).second;
    if (!exclude) excluded_.erase({low, high});
    scene_.ignorePair(b, a, exclude);
  }

  void changeFilter() {
    filter_ = static_cast<int>(random_.unit() * 4);
    if (filter_ == 0) {
      scene_.setFilter({});
    } else {
      scene_.setFilter([n = filter_](int a, int b) { return (a + b) % n != 0; });
    }
  }

  SceneSettings settings_;
  scenes::Random random_;
  std::vector<Mesh> meshes_;
  std::map<int, Object> objects_;
  std::set<std::pair<int, int>> excluded_;
  int filter_ = 0;
  SceneDistance<double> scene_;
};

}  // namespace kios::testing
