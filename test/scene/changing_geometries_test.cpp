// SPDX-FileCopyrightText: 2026 The fcl_kios authors
// SPDX-License-Identifier: BSD-3-Clause
//
// Geometries that change in place while nothing moves, and nobody is told: shapes of new sizes,
// octrees that take up measurements, classes of the user's.

#include <fcl/broadphase/broadphase_bruteforce.h>
#include <gtest/gtest.h>
#include <octomap/octomap.h>

#include <functional>

#include "fcl/mesh_cases.h"
#include "fcl_kios/scene.h"

namespace kios::testing {
namespace {

using Geometry = std::shared_ptr<fcl::CollisionGeometryd>;

/// Holds a geometry, and its n-th change.
struct Changing {
  std::string name;
  Geometry geometry;
  std::function<void(int n)> change;
  bool remembered = true;  ///< its distances, as long as it doesn't change
};

/// Holds a shape of the user's own, which depends on what no library can know.
class Inflated final : public fcl::Sphered {
 public:
  using fcl::Sphered::Sphered;
};

std::vector<Changing> changingGeometries() {
  std::vector<Changing> all;
  const auto add = [&](const char* name, const auto& shape, auto change, bool remembered = true) {
    all.push_back({name, shape, [shape, change](int n) { change(*shape, 0.1 * n); }, remembered});
  };
  add("box, x", std::make_shared<fcl::Boxd>(1, 1, 1), [](auto& s, double d) { s.side[0] = 1 + d; });
  add("box, z", std::make_shared<fcl::Boxd>(1, 1, 1), [](auto& s, double d) { s.side[2] = 1 + d; });
  add("sphere", std::make_shared<fcl::Sphered>(0.5), [](auto& s, double d) { s.radius = 0.5 + d; });
  add("ellipsoid", std::make_shared<fcl::Ellipsoidd>(0.5, 0.6, 0.7),
      [](auto& s, double d) { s.radii[0] = 0.5 + d; });
  add("capsule", std::make_shared<fcl::Capsuled>(0.5, 1),
      [](auto& s, double d) { s.radius = 0.5 + d; });
  add("long capsule", std::make_shared<fcl::Capsuled>(0.1, 1),
      [](auto& s, double d) { s.lz = 1 + d; });
  add("cylinder", std::make_shared<fcl::Cylinderd>(0.5, 1),
      [](auto& s, double d) { s.radius = 0.5 + d; });
  add("cone", std::make_shared<fcl::Coned>(0.5, 1), [](auto& s, double d) { s.radius = 0.5 + d; });
  add("half-space", std::make_shared<fcl::Halfspaced>(Vector3d(1, 0, 0), 0),
      [](auto& s, double d) { s.d = d; });
  add("plane", std::make_shared<fcl::Planed>(Vector3d(1, 0, 0), 0),
      [](auto& s, double d) { s.d = d; });
  const auto points = std::make_shared<std::vector<Vector3d>>(
      std::vector<Vector3d>{{0, -1, -1}, {0, 1, -1}, {0, 0, 1}, {-1, 0, 0}});
  const auto faces = std::make_shared<std::vector<int>>(
      std::vector<int>{3, 0, 1, 2, 3, 0, 3, 1, 3, 1, 3, 2, 3, 0, 2, 3});
  add("convex", std::make_shared<fcl::Convexd>(points, 4, faces), [points](auto& /*s*/, double d) {
    (*points)[2] = {d, 0, 1};
  });
  add(
      "a class of the user's", std::make_shared<Inflated>(0.5),
      [](auto& s, double d) { s.radius = 0.5 + d; }, false);
  const auto cells = std::make_shared<octomap::OcTree>(0.05);
  cells->updateNode(octomap::point3d(0.0F, 0.02F, 0.02F), true);
  add(
      "octree", std::make_shared<fcl::OcTreed>(std::shared_ptr<const octomap::OcTree>(cells)),
      [cells](auto& /*tree*/, double d) {
        cells->updateNode(octomap::point3d(static_cast<float>(d), 0.02F, 0.02F), true);
      },
      false);
  return all;
}

// mesh_fuzz asks this of ManagerQuery too, which remembers the same of geometries.
TEST(ChangingGeometries, ScenesSeeTheChange) {
  const fcl::Transform3d away(fcl::Translation3d(3, 2.5, 2.8));
  const auto mesh = kiosModel(scenes::icosphere(0.5, 2));
  for (const Changing& c : changingGeometries()) {
    SceneDistanced scene;
    scene.add(mesh, away);
    const int id = scene.add(c.geometry, fcl::Transform3d::Identity());
    long long still = 0;
    double last = -1;
    for (int frame = 0; frame < 16; ++frame) {
      if (frame % 2 == 0) {
        c.change(frame / 2);
        if (!c.remembered && c.name != "octree") scene.changed(id);  // its box has grown
      }
      fcl::DistanceResultd result;
      const double d = fcl::distance(mesh.get(), away, c.geometry.get(),
                                     fcl::Transform3d::Identity(), fcl::DistanceRequestd(), result);
      EXPECT_EQ(d == last, frame % 2 == 1) << c.name << " " << frame;
      last = d;
      const auto closest = scene.closestPair();
      still += scene.counts().still;
      ASSERT_TRUE(closest.has_value());
      EXPECT_EQ(closest->distance, d) << c.name << " " << frame;
      for (const double margin : {0.5 * d, 2 * d}) {
        const auto within = scene.pairsWithin(margin);
        EXPECT_EQ(within.size(), margin < d ? 0U : 1U) << c.name << " " << frame;
      }
      EXPECT_EQ(scene.clearances().at(0).distance, d) << c.name;
    }
    EXPECT_EQ(still, c.remembered ? 8 : 0) << c.name;
  }
}

// What stands still and is what it was is not searched again: with another pose it is.
TEST(ShapesOfScenes, AreComparedByTheirSizes) {
  const auto box = std::make_shared<fcl::Boxd>(1, 1, 1),
             same = std::make_shared<fcl::Boxd>(1, 1, 1);
  SceneDistanced scene;
  scene.add(kiosModel(scenes::icosphere(0.5, 1)), fcl::Transform3d::Identity());
  scene.add(box, fcl::Transform3d(fcl::Translation3d(2, 0, 0)));
  scene.add(same, fcl::Transform3d(fcl::Translation3d(-2, 0, 0)));
  scene.clearances();
  EXPECT_EQ(scene.counts().queried, 3);
  scene.clearances();
  EXPECT_EQ(scene.counts().queried, 0);
  box->side[1] = 1.5;
  scene.clearances();
  EXPECT_EQ(scene.counts().queried, 2);
  box->side[1] = 1.5;  // the same
  scene.clearances();
  EXPECT_EQ(scene.counts().queried, 0);
  EXPECT_THROW(scene.ignorePair(1, 1), std::invalid_argument);
  EXPECT_NO_THROW(scene.ignorePair(1, 2));
}

}  // namespace
}  // namespace kios::testing
