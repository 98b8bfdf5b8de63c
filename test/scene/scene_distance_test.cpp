// SPDX-FileCopyrightText: 2026 The fcl_kios authors
// SPDX-License-Identifier: BSD-3-Clause
//
// Scene queries against fcl::distance over all pairs: equal in every frame, bit for bit.

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

namespace kios::testing {
namespace {

/// Holds the spread of a scene's objects, their size, and their place in the world.
struct SceneSettings {
  int objects = 8;
  double spread = 2;
  Vector3d offset = Vector3d::Zero();
  bool shapes = false;  ///< geometries of FCL as well
  bool obstacles = false;
};

/// A scene that changes at random, and what brute force says of it.
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

using Truth = std::map<std::pair<int, int>, fcl::DistanceResultd>;

void expectSum(const SceneCounts& counts, std::size_t objects) {
  EXPECT_EQ(counts.total, static_cast<long long>(objects * (objects - 1) / 2));
  EXPECT_EQ(counts.total, counts.filtered + counts.far_boxes + counts.far_roots + counts.still +
                              counts.ties + counts.queried);
  EXPECT_LE(counts.proven_farther, counts.queried);
}

void expectPoints(const ScenePair<double>& pair, const fcl::DistanceResultd& truth) {
  if (pair.distance > 1e4) return;  // FCL's tree, which serves there, takes any of equal distances
  EXPECT_EQ(pair.nearest_a, truth.nearest_points[0]);
  EXPECT_EQ(pair.nearest_b, truth.nearest_points[1]);
  EXPECT_EQ(pair.triangle_a, truth.b1);
  EXPECT_EQ(pair.triangle_b, truth.b2);
}

void expectClosest(RandomScene& random, const Truth& truth, bool points) {
  SceneRequest request;
  request.nearest_points = points;
  const auto closest = random.scene().closestPair(request);
  expectSum(random.scene().counts(), random.objects().size());
  ASSERT_EQ(closest.has_value(), !truth.empty());
  if (!closest) return;
  auto best = truth.begin();
  for (auto it = truth.begin(); it != truth.end(); ++it) {
    if (it->second.min_distance < best->second.min_distance) best = it;
  }
  EXPECT_EQ(std::pair(closest->a, closest->b), best->first);
  EXPECT_EQ(closest->distance, best->second.min_distance);
  if (points && closest->distance > 0) expectPoints(*closest, best->second);
}

void expectWithin(RandomScene& random, const Truth& truth, double margin, bool exact, bool points) {
  SceneRequest request;
  request.exact = exact;
  request.nearest_points = points;
  const auto pairs = random.scene().pairsWithin(margin, request);
  expectSum(random.scene().counts(), random.objects().size());
  auto it = pairs.begin();
  for (const auto& [ids, result] : truth) {
    if (!(result.min_distance <= margin)) continue;
    ASSERT_NE(it, pairs.end());
    ASSERT_EQ(std::pair(it->a, it->b), ids);
    if (exact) {
      EXPECT_EQ(it->distance, result.min_distance);
      if (points && it->distance > 0) expectPoints(*it, result);
    } else {
      // Other triangles with the same nearest points may round otherwise.
      EXPECT_GE(it->distance, result.min_distance - 1e-13 * std::abs(result.min_distance));
      EXPECT_LE(it->distance, margin);
    }
    ++it;
  }
  EXPECT_EQ(it, pairs.end());
}

void expectClearances(RandomScene& random, const Truth& truth, bool points) {
  SceneRequest request;
  request.nearest_points = points;
  const auto pairs = random.scene().clearances(request);
  expectSum(random.scene().counts(), random.objects().size());
  ASSERT_EQ(pairs.size(), truth.size());
  auto it = pairs.begin();
  for (const auto& [ids, result] : truth) {
    ASSERT_EQ(std::pair(it->a, it->b), ids);
    EXPECT_EQ(it->distance, result.min_distance);
    if (points && it->distance > 0) expectPoints(*it, result);
    ++it;
  }
}

/// Returns a margin below, at, just above or far above a distance of the scene, or anything.
double anyMargin(RandomScene& random, const Truth& truth) {
  const double how = random.random().unit();
  if (how < 0.1) return 0;
  if (how < 0.15) return std::numeric_limits<double>::infinity();
  if (how < 0.2) return -1;
  if (how < 0.6 || truth.empty()) return std::pow(10, random.random().uniform(-3, 1));
  auto it = truth.begin();
  std::advance(it, static_cast<int>(random.random().unit() * static_cast<double>(truth.size())));
  const double distance = it->second.min_distance;
  return how < 0.8 ? distance : std::nextafter(distance, 1e9);
}

void runFrames(const SceneSettings& settings, int frames, std::uint64_t seed) {
  RandomScene random(settings, seed);
  for (int frame = 0; frame < frames; ++frame) {
    SCOPED_TRACE(::testing::Message() << "seed " << seed << " frame " << frame);
    random.change();
    const Truth truth = random.bruteForce();
    const double kind = random.random().unit();
    const bool points = random.random().unit() < 0.3;
    if (kind < 0.5) expectClosest(random, truth, points);
    if (kind > 0.3 && kind < 0.9) {
      expectWithin(random, truth, anyMargin(random, truth), random.random().unit() < 0.6, points);
    }
    if (kind > 0.8) expectClearances(random, truth, points);
    if (kind < 0.01) random.scene().forget();
    if (::testing::Test::HasFailure()) return;
  }
}

TEST(SceneDistance, EqualsBruteForce) {
  const SceneSettings crowded{6, 1}, loose{7, 4}, sparse{8, 40},
      far{6, 2, Vector3d(1e9, -2e9, 5e8)}, shapes{7, 3, Vector3d::Zero(), true},
      obstacles{9, 3, Vector3d::Zero(), false, true};
  std::uint64_t seed = 0;
  for (int i = 0; i < 40; ++i) runFrames(crowded, 150, ++seed);
  for (int i = 0; i < 40; ++i) runFrames(loose, 150, ++seed);
  for (int i = 0; i < 20; ++i) runFrames(sparse, 150, ++seed);
  for (int i = 0; i < 15; ++i) runFrames(far, 120, ++seed);
  for (int i = 0; i < 15; ++i) runFrames(shapes, 120, ++seed);
  for (int i = 0; i < 20; ++i) runFrames(obstacles, 120, ++seed);
}

// Many bodies that fly straight: near pairs are listed for several frames.
TEST(SceneDistance, EqualsBruteForceInAStream) {
  constexpr int kBodies = 24;
  scenes::Random random(7);
  std::vector<std::shared_ptr<Modeld>> models;
  std::vector<Vector3d> velocities;
  SceneDistance<double> scene;
  auto poses = scenes::randomPoses(kBodies, 3, 70);
  for (int i = 0; i < kBodies; ++i) {
    models.push_back(kiosModel(i % 2 == 0 ? scenes::icosphere(0.2, 0) : scenes::bumpyTorus(100)));
    velocities.emplace_back(random.uniform(-1, 1), random.uniform(-1, 1), random.uniform(-1, 1));
    scene.add(models.back(), poses[i]);
  }
  for (int frame = 0; frame < 500; ++frame) {
    const double speed = frame < 250 ? 0.02 : 0.1;
    for (int i = 0; i < kBodies; ++i) {
      Vector3d t = poses[i].translation() + speed * velocities[i];
      for (int axis = 0; axis < 3; ++axis) {
        if (std::abs(t[axis]) > 3) velocities[i][axis] = -velocities[i][axis];
      }
      poses[i].translation() += speed * velocities[i];
      scene.move(i, poses[i]);
    }
    std::vector<std::tuple<double, int, int>> truth;
    for (int a = 0; a < kBodies; ++a) {
      for (int b = a + 1; b < kBodies; ++b) {
        fcl::DistanceResultd result;
        const double distance = fcl::distance(models[a].get(), poses[a], models[b].get(), poses[b],
                                              fcl::DistanceRequestd(), result);
        truth.emplace_back(distance, a, b);
      }
    }
    std::sort(truth.begin(), truth.end());
    if (frame % 3 != 0) {
      const auto closest = scene.closestPair();
      expectSum(scene.counts(), kBodies);
      ASSERT_EQ(std::tuple(closest->distance, closest->a, closest->b), truth[0]) << frame;
    }
    const double margin = frame % 100 < 50 ? 0.05 : 0.3;
    std::vector<std::tuple<double, int, int>> within;
    for (const auto& pair : scene.pairsWithin(margin)) {
      within.emplace_back(pair.distance, pair.a, pair.b);
    }
    expectSum(scene.counts(), kBodies);
    std::sort(within.begin(), within.end());
    truth.erase(std::lower_bound(truth.begin(), truth.end(), std::tuple(margin, -1, -1)),
                truth.end());
    ASSERT_EQ(within, truth) << frame;
  }
}

}  // namespace
}  // namespace kios::testing
