// SPDX-FileCopyrightText: 2026 The fcl_kios authors
// SPDX-License-Identifier: BSD-3-Clause
//
// 125 tori that drift: the nearest pair in each frame by one of FCL's broadphase managers with
// FCL's default callbacks, by kios::ManagerQuery on the same manager, and by kios::SceneDistance,
// which needs no manager. All three agree, or the program fails.
//
// usage: broadphase_scene [FRAMES]
#include <fcl_kios/fcl_kios.h>

#include <chrono>
#include <cstdio>
#include <cstdlib>
#include <memory>
#include <vector>

#include "shapes.h"

namespace {

constexpr int kSide = 5;
constexpr double kMargin = 0.25;

/// The pose of body i in a frame. Bodies stand in a grid of spacing 3, where they sway and turn.
fcl::Transform3d poseOf(int i, int frame) {
  const double phase = 0.7 * i, t = 0.02 * frame;
  const fcl::Vector3d home(i % kSide, i / kSide % kSide, i / (kSide * kSide));
  const fcl::Vector3d sway(std::sin(t + phase), std::sin(1.3 * t + 2 * phase), std::cos(t + phase));
  fcl::Transform3d X_W = fcl::Transform3d::Identity();
  X_W.translation() = 3 * home + 0.37 * sway;
  X_W.linear() =
      fcl::AngleAxisd(t + phase, fcl::Vector3d(1, std::cos(phase), std::sin(phase)).normalized())
          .toRotationMatrix();
  return X_W;
}

class Stopwatch {
 public:
  template <typename Work>
  void time(const Work& work) {
    const auto begin = std::chrono::steady_clock::now();
    work();
    seconds_ += std::chrono::duration<double>(std::chrono::steady_clock::now() - begin).count();
  }
  double microseconds(int frames) const { return 1e6 * seconds_ / frames; }

 private:
  double seconds_ = 0;
};

}  // namespace

int main(int argc, char** argv) {
  const int frames = argc > 1 ? std::atoi(argv[1]) : 60;
  if (frames < 1) {
    std::fprintf(stderr, "broadphase_scene: '%s' is no number of frames\n", argv[1]);
    return 2;
  }
  const auto torus = shapes::bumpyTorus<double>(1, 0.35, 48, 20);
  const auto mesh = kios::makeModel(torus.vertices, torus.triangles);

  std::vector<std::unique_ptr<fcl::CollisionObjectd>> objects;
  fcl::DynamicAABBTreeCollisionManagerd manager;
  kios::SceneDistanced scene;
  for (int i = 0; i < kSide * kSide * kSide; ++i) {
    objects.push_back(std::make_unique<fcl::CollisionObjectd>(mesh, poseOf(i, 0)));
    manager.registerObject(objects.back().get());
    scene.add(objects.back().get());  // reads the object's pose at each query
  }
  manager.setup();

  kios::ManagerQueryd query;
  Stopwatch by_manager, by_query, by_scene;
  long long searched = 0, total = 0, near_pairs = 0, touching = 0;
  for (int frame = 0; frame < frames; ++frame) {
    for (std::size_t i = 0; i < objects.size(); ++i) {
      objects[i]->setTransform(poseOf(static_cast<int>(i), frame));
      objects[i]->computeAABB();
    }
    manager.update();

    fcl::DefaultDistanceData<double> distance;
    by_manager.time([&] { manager.distance(&distance, fcl::DefaultDistanceFunction<double>); });

    query.findClosest();
    by_query.time([&] { manager.distance(&query, kios::ManagerQueryd::callback); });

    std::optional<kios::ScenePaird> closest;
    by_scene.time([&] { closest = scene.closestPair(); });
    searched += scene.counts().queried;
    total += scene.counts().total;

    // The manager may name the pair in the other order, and then distances differ by rounding.
    const double d = closest->distance;
    const double rounding = 1e-13;
    if (std::abs(distance.result.min_distance - d) > rounding || query.pairs().size() != 1 ||
        std::abs(query.pairs()[0].distance - d) > rounding) {
      std::fprintf(stderr, "frame %d: the answers differ\n", frame);
      return 1;
    }
    fcl::DefaultCollisionData<double> collision;
    manager.collide(&collision, fcl::DefaultCollisionFunction<double>);
    if (collision.result.isCollision() != (d == 0)) {
      std::fprintf(stderr, "frame %d: distance %g, but collision says otherwise\n", frame, d);
      return 1;
    }
    touching += d == 0 ? 1 : 0;
    near_pairs += static_cast<long long>(scene.pairsWithin(kMargin).size());
  }

  std::printf("%zu tori of %zu triangles, %d frames, in %lld of which something touches\n",
              objects.size(), torus.triangles.size(), frames, touching);
  std::printf(
      "closest pair, us a frame: FCL's manager and callback %.0f, ManagerQuery %.0f, "
      "SceneDistance %.0f\n",
      by_manager.microseconds(frames), by_query.microseconds(frames),
      by_scene.microseconds(frames));
  std::printf("SceneDistance searched %.1f of %lld pairs a frame; %.1f are nearer than %g\n",
              static_cast<double>(searched) / frames, total / frames,
              static_cast<double>(near_pairs) / frames, kMargin);
}
