// SPDX-FileCopyrightText: 2026 The fcl_kios authors
// SPDX-License-Identifier: BSD-3-Clause
//
// The callback for FCL's managers, against fcl::distance over all pairs.

#include "fcl_kios/scene.h"

#include <fcl/broadphase/broadphase_SSaP.h>
#include <fcl/broadphase/broadphase_bruteforce.h>

#include "model/deform.h"
#include "scenes/random.h"

namespace kios::testing {
namespace {

using Object = fcl::CollisionObjectd;
using Query = ManagerQuery<double>;

class Bodies {
 public:
  Bodies(int count, double spread, std::uint64_t seed) {
    const std::vector<Mesh> shapes{scenes::icosphere(0.5, 1), scenes::bumpyTorus(100),
                                   scenes::sheet(1, 1, 3, 3, 0.2)};
    const auto poses = scenes::randomPoses(count, spread, seed);
    for (int i = 0; i < count; ++i) {
      meshes.push_back(shapes[i % shapes.size()]);
      models.push_back(kiosModel(meshes.back()));
      objects.push_back(std::make_unique<Object>(models.back(), poses[i]));
    }
  }
  void place(int i, const Transform3d& X) {
    objects[i]->setTransform(X);
    objects[i]->computeAABB();
  }
  static double distance(const Object* a, const Object* b) {
    fcl::DistanceResultd result;
    return fcl::distance(a, b, fcl::DistanceRequestd(), result);
  }

  std::vector<Mesh> meshes;
  std::vector<std::shared_ptr<Modeld>> models;
  std::vector<std::unique_ptr<Object>> objects;
};

// Each answer is that of the order in which the manager gave the pair, whichever was first.
TEST(ManagerQuery, KeepsTheManagersOrder) {
  Bodies bodies(6, 2, 7);
  Query query;
  scenes::Random random(9);
  int differing = 0;
  for (int frame = 0; frame < 40; ++frame) {
    for (const bool closest : {false, true}) {
      for (int i = 0; i < 6; ++i) {
        for (int j = 0; j < i; ++j) {
          Object *o1 = bodies.objects[i].get(), *o2 = bodies.objects[j].get();
          if (random.unit() < 0.5) std::swap(o1, o2);
          if (closest) {
            query.findClosest();
          } else {
            query.findWithin(100);
          }
          double dist = 100;
          Query::callback(o1, o2, &query, dist);
          Query::callback(o2, o1, &query, dist);  // the same pair: no matter
          ASSERT_EQ(query.pairs().size(), 1u);
          const auto& pair = query.pairs()[0];
          EXPECT_EQ(pair.a, o1);
          EXPECT_EQ(pair.b, o2);
          fcl::DistanceResultd result;
          EXPECT_EQ(pair.distance, fcl::distance(o1, o2, fcl::DistanceRequestd(), result));
          if (pair.distance > 0) {
            EXPECT_EQ(pair.triangle_a, result.b1);
            EXPECT_EQ(pair.triangle_b, result.b2);
          }
          differing += pair.distance != Bodies::distance(o2, o1);
        }
      }
    }
    bodies.place(frame % 6, scenes::randomPoses(1, 2, 100 + frame)[0]);
  }
  EXPECT_GT(differing, 0);  // or the orders could not be told apart
}

TEST(ManagerQuery, SearchesNothingTwice) {
  Bodies bodies(8, 2, 6);
  fcl::NaiveCollisionManagerd manager;
  for (const auto& object : bodies.objects) manager.registerObject(object.get());
  Query query([&](const Object* a, const Object* b) {
    return a != bodies.objects[0].get() && b != bodies.objects[0].get();
  });
  query.findWithin(5);
  manager.distance(&query, Query::callback);
  EXPECT_EQ(query.counts().filtered, 7);
  EXPECT_EQ(query.counts().queried + query.counts().far_roots, 21);
  query.findWithin(5);
  manager.distance(&query, Query::callback);
  EXPECT_EQ(query.counts().queried, 0);
  EXPECT_THROW(query.findWithin(std::nan("")), std::invalid_argument);
}

// A rotation within 1e-12 of none moves content 1e4 from its origin by 1e-8; not its box in FCL.
TEST(ManagerQuery, MissesWhatRotationsThatFclLeavesOutBringNear) {
  static constexpr double kFar = 1e4, kAngle = 9e-13;
  const auto plate = [](double z) {
    return kiosModel({{{kFar, 0, z}, {kFar + 1, 0, z}, {kFar, 1, z}}, {{0, 1, 2}}});
  };
  const Transform3d still = Transform3d::Identity();
  Transform3d turned = still;
  turned.rotate(Eigen::AngleAxisd(kAngle, fcl::Vector3d::UnitY()));
  Object a(plate(0), still), below(plate(-5e-9), still), above(plate(1e-8), turned);
  const double least = Bodies::distance(&a, &above);
  EXPECT_LT(least, 2e-9);
  EXPECT_GT(above.getAABB().min_.z(), least);  // its content is outside of its box

  fcl::NaiveCollisionManagerd manager;
  SceneDistance<double> scene;
  for (Object* const object : {&a, &below, &above}) {
    manager.registerObject(object);
    scene.add(object);
  }
  Query query;
  query.findClosest();
  manager.distance(&query, Query::callback);
  ASSERT_EQ(query.pairs().size(), 1u);
  EXPECT_GT(query.pairs()[0].distance, least);
  EXPECT_LE(query.pairs()[0].distance, least + 4e-12 * (kFar + 1));
  const auto closest = scene.closestPair();
  ASSERT_TRUE(closest.has_value());
  EXPECT_EQ(closest->distance, least);
}

}  // namespace
}  // namespace kios::testing
