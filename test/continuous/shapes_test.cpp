// SPDX-FileCopyrightText: 2026 The fcl_kios authors
// SPDX-License-Identifier: BSD-3-Clause
//
// Moving meshes against the nine moving shapes and octrees, both orders: known times of contact,
// and random motions against dense sampling by the static query.

#include <cmath>
#include <cstdio>
#include <map>
#include <random>

#include "continuous/moving_meshes.h"
#include "scenes/shape_geometry.h"

namespace kios::testing {
namespace {

using Geometry = std::shared_ptr<fcl::CollisionGeometryd>;

std::map<std::string, Geometry> shapes() {
  const auto corners = std::make_shared<std::vector<Vector3d>>(
      std::vector<Vector3d>{{1, 0, 0}, {-1, 0, 0}, {0, 1, 0}, {0, -1, 0}, {0, 0, 1}, {0, 0, -1}});
  const auto faces = std::make_shared<std::vector<int>>(
      std::vector<int>{3, 0, 2, 4, 3, 2, 1, 4, 3, 1, 3, 4, 3, 3, 0, 4,
                       3, 2, 0, 5, 3, 1, 2, 5, 3, 3, 1, 5, 3, 0, 3, 5});
  return {{"box", std::make_shared<fcl::Boxd>(2, 2, 2)},
          {"sphere", std::make_shared<fcl::Sphered>(1)},
          {"ellipsoid", std::make_shared<fcl::Ellipsoidd>(1, 0.7, 0.5)},
          {"capsule", std::make_shared<fcl::Capsuled>(0.3, 2)},
          {"cone", std::make_shared<fcl::Coned>(0.8, 1.5)},
          {"cylinder", std::make_shared<fcl::Cylinderd>(0.5, 2)},
          {"convex", std::make_shared<fcl::Convexd>(corners, 8, faces)},
          {"plane", std::make_shared<fcl::Planed>(Vector3d(1, 0.2, 0).normalized(), 0.3)},
          {"halfspace", std::make_shared<fcl::Halfspaced>(Vector3d(0, 0.3, 1).normalized(), -1)}};
}

TEST(ShapeContact, KnownTimes) {
  const Geometry box = kiosModel(scenes::subdividedBox({2, 2, 2}, 2));
  const std::map<std::string, double> reach = {{"box", 1},        {"sphere", 1},
                                               {"ellipsoid", 1},  {"capsule", 0.3},
                                               {"cylinder", 0.5}, {"convex", 1}};
  const auto all = shapes();
  for (auto type : kMotionTypes) {
    const Motion still = motionOf(type, at(0, 0, 0), at(0, 0, 0));
    for (const auto& [name, along] : reach) {
      const Motion moving = motionOf(type, at(10, 0, 0), at(-10, 0, 0));
      const auto result = askBoth(*box, *still, *all.at(name), *moving, 1e-6);
      // FCL's screws without a turn go |way| times too far.
      const double scale = type == fcl::CCDM_SCREW ? 400 : 20;
      EXPECT_TRUE(result.is_collide) << name;
      EXPECT_NEAR(result.time_of_contact, (9 - along) / scale, 1e-6) << name;
      EXPECT_LE(result.time_of_contact, (9 - along) / scale + 1e-12) << name;
      const Motion beside = motionOf(type, at(10, 1.001 + along, 0), at(-10, 1.001 + along, 0));
      if (name != "ellipsoid") {
        EXPECT_FALSE(askBoth(*box, *still, *all.at(name), *beside, 1e-6).is_collide) << name;
      }
    }
  }
}

TEST(OctreeContact, KnownTimes) {
  const auto box = kiosModel(scenes::subdividedBox({2, 2, 2}, 2));
  const Geometry cells =
      scenes::octreeOf({{0.1, 0.1, 0.1}, {0.1, 3.1, 0.1}}, 0.5);  // [0, 0.5]^3, and beside
  const Motion still = motionOf(fcl::CCDM_TRANS, at(0, 0, 0), at(0, 0, 0));
  const Motion shoot = motionOf(fcl::CCDM_TRANS, at(100.5, 0.2, 0.3), at(-99.5, 0.2, 0.3));
  auto result = askBoth(*box, *shoot, *cells, *still, 1e-7);
  EXPECT_TRUE(result.is_collide);
  EXPECT_NEAR(result.time_of_contact, 99. / 200, 1e-7);
  // Between the cells; inside a full cell at the start; away from all.
  const Motion between = motionOf(fcl::CCDM_LINEAR, at(9, 1.75, 0.3), at(-9, 1.75, 0.3));
  EXPECT_FALSE(askBoth(*box, *between, *cells, *still, 1e-7).is_collide);
  const auto grain = kiosModel(scenes::subdividedBox({0.1, 0.1, 0.1}, 1));
  const Motion inside = motionOf(fcl::CCDM_TRANS, at(0.25, 0.25, 0.25), at(9, 0.25, 0.25));
  EXPECT_EQ(askBoth(*grain, *inside, *cells, *still, 1e-7).time_of_contact, 0);
  const Motion away = motionOf(fcl::CCDM_TRANS, at(50, 50, 50), at(90, 50, 40));
  EXPECT_FALSE(askBoth(*box, *away, *cells, *still, 1e-7).is_collide);
  const fcl::OcTreed nothing(0.1);
  EXPECT_FALSE(askBoth(*box, *shoot, nothing, *still, 1e-7).is_collide);
}

TEST(ShapeContact, RandomMotionsAgreeWithDenseSampling) {
  RandomPoses random(7);
  const auto motion = [&](fcl::CCDMotionType type) -> Motion {
    if (type != fcl::CCDM_SPLINE) return motionOf(type, random.pose(3), random.pose(3));
    return std::make_shared<fcl::SplineMotion<double>>(
        random.point(4), random.point(4), random.point(4), random.point(4), random.point(9),
        random.point(9), random.point(9), random.point(9));
  };
  const Geometry meshes[] = {kiosModel(scenes::bumpyTorus(300)),
                             kiosModel(scenes::randomSoup(60, 1, 1e-2, 1, 3)),
                             kiosModel(scenes::singleTriangle({1, 0, 0}, {-1, 1, 0}, {0, -1, 1}))};
  Outcomes outcomes;
  auto others = shapes();
  std::vector<Vector3d> points;
  for (int i = 0; i < 60; ++i) points.push_back(random.point(2));
  others["octree"] = scenes::octreeOf(points, 0.1);
  for (const auto& [name, solid] : others) {
    for (auto type : kMotionTypes) {
      for (int i = 0; i < 45; ++i) {
        SCOPED_TRACE(name + " " + std::to_string(type) + " " + std::to_string(i));
        const Geometry& mesh = meshes[i % 3];
        const Motion a = motion(type), b = motion(type);
        const double toc_err = 1e-5;
        const auto result = askBoth(*mesh, *a, *solid, *b, toc_err, &outcomes.counts);
        expectRight({*mesh, *a, *solid, *b}, result, toc_err, 400, 1e-2 * toc_err);
        ++outcomes.queries;
        outcomes.hits += result.is_collide;
      }
    }
  }
  outcomes.expectBothKinds();
}

}  // namespace
}  // namespace kios::testing
