// SPDX-FileCopyrightText: 2026 The fcl_kios authors
// SPDX-License-Identifier: BSD-3-Clause

#include <algorithm>
#include <cmath>

#include "cad_shapes.h"
#include "motions.h"
#include "random.h"
#include "robots.h"
#include "shapes.h"

namespace kios::scenes {
namespace {

using fcl::Transform3d;
using fcl::Vector3d;

constexpr int kBodiesPerMesh = 10;

// About 0.3 across, 120 to 600 triangles.
Mesh part(int kind, Random& random) {
  const double size = random.uniform(0.8, 1.2);
  switch (kind % 4) {
    case 0:
      return flangedCylinder(0.06 * size, 0.25 * size, 16);
    case 1:
      return boredBlock(Vector3d(0.25, 0.2, 0.1) * size, 0.02, 0.01, 0.04 * size, 24);
    case 2:
      return icosphere(0.13 * size, 2);
    default: {
      Mesh torus = bumpyTorus(400);
      for (Vector3d& p : torus.vertices) p *= 0.1 * size;
      return torus;
    }
  }
}

std::vector<Mesh> parts(int count, Random& random) {
  std::vector<Mesh> meshes;
  for (int i = 0; i < count; ++i) meshes.push_back(part(i, random));
  return meshes;
}

}  // namespace

BodyScene driftingCrowd(int count, int frames, std::uint64_t seed) {
  constexpr double kSpacing = 0.5, kJitter = 0.06, kDrift = 0.03;
  Random random(seed);
  BodyScene scene;
  scene.meshes = parts((count + kBodiesPerMesh - 1) / kBodiesPerMesh, random);
  scene.obstacle.assign(count, false);
  const int side = static_cast<int>(std::ceil(std::cbrt(count)));
  const auto turned = randomPoses(count, 1, seed + 1);
  struct Drift {
    Vector3d place, swing, phase;
    double speed;
  };
  std::vector<Drift> drifts;
  for (int i = 0; i < count; ++i) {
    scene.mesh_of.push_back(i / kBodiesPerMesh);
    const Vector3d cell(i % side, i / side % side, i / side / side);
    const Vector3d place = kSpacing * cell + random.inCube(-kJitter, kJitter);
    const Vector3d swing = random.inCube(-kDrift, kDrift), phase = random.inCube(-3, 3);
    drifts.push_back({place, swing, phase, random.uniform(0.02, 0.08)});
  }
  for (int frame = 0; frame < frames; ++frame) {
    std::vector<Transform3d> poses;
    for (int i = 0; i < count; ++i) {
      const Drift& drift = drifts[i];
      Transform3d X = Transform3d::Identity();
      X.linear() = turned[i].linear() *
                   fcl::AngleAxisd(0.3 * drift.speed * frame, Vector3d::UnitZ()).matrix();
      for (int axis = 0; axis < 3; ++axis) {
        X.translation()[axis] =
            drift.place[axis] +
            drift.swing[axis] * std::sin(drift.speed * frame + drift.phase[axis]);
      }
      poses.push_back(X);
    }
    scene.frames.push_back(std::move(poses));
  }
  return scene;
}

BodyScene packedCrowd(int count, int triangles, double spacing, std::uint64_t seed) {
  const int segments = triangles < 400 ? 10 : 30;
  Random random(seed);
  BodyScene scene;
  scene.obstacle.assign(count, false);
  scene.frames.push_back(randomPoses(count, 1, seed + 1));
  const int side = static_cast<int>(std::ceil(std::cbrt(count)));
  for (int i = 0; i < count; ++i) {
    const Vector3d size = random.inCube(0.2, 0.4), phase = random.inCube(0, 3);
    Mesh mesh = uvSphere(0.5, triangles / (2 * segments) + 1, segments);
    for (Vector3d& p : mesh.vertices) {
      const double bump = std::sin(9 * p.x() + phase.x()) * std::sin(9 * p.y() + phase.y());
      p = (1 + 0.1 * bump) * p.cwiseProduct(size);
    }
    scene.meshes.push_back(std::move(mesh));
    scene.mesh_of.push_back(i);
    const Vector3d cell(i % side, i / side % side, i / side / side);
    scene.frames[0][i].translation() = spacing * (cell + random.inCube(-0.1, 0.1));
  }
  return scene;
}

BodyScene roadmap(const Robot& robot, int count, int configurations, std::uint64_t seed) {
  constexpr double kHalfWidth = 6, kClearOfBase = 0.45;
  const int links = static_cast<int>(robot.links.size());
  Random random(seed);
  BodyScene scene;
  for (const Link& link : robot.links) scene.meshes.push_back(link.mesh);
  for (Mesh& mesh : parts((count + kBodiesPerMesh - 1) / kBodiesPerMesh, random)) {
    scene.meshes.push_back(std::move(mesh));
  }
  for (int i = 0; i < links; ++i) scene.mesh_of.push_back(i);
  scene.excluded = allowedPairs(robot);
  std::vector<Transform3d>& places = scene.places;
  for (std::uint64_t batch = 0; static_cast<int>(places.size()) < count; ++batch) {
    for (const Transform3d& X : randomPoses(count, kHalfWidth, seed + 100 + batch)) {
      const Vector3d& t = X.translation();
      const bool clear = std::hypot(t.x(), t.y()) > kClearOfBase;
      if (clear && static_cast<int>(places.size()) < count) places.push_back(X);
    }
  }
  // Obstacles of a mesh stand near each other, so that some meshes are far from the robot.
  std::sort(places.begin(), places.end(), [](const Transform3d& a, const Transform3d& b) {
    return a.translation().norm() < b.translation().norm();
  });
  for (int i = 0; i < count; ++i) scene.mesh_of.push_back(links + i / kBodiesPerMesh);
  scene.obstacle.assign(links, false);
  scene.obstacle.resize(scene.mesh_of.size(), true);
  for (const auto& angles : jointMotion(robot, configurations, false, seed)) {
    scene.frames.push_back(robotPoses(robot, Transform3d::Identity(), angles));
  }
  return scene;
}

}  // namespace kios::scenes
