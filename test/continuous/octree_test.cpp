// SPDX-FileCopyrightText: 2026 The fcl_kios authors
// SPDX-License-Identifier: BSD-3-Clause
//
// Moving meshes against moving octrees, both orders: known times, and dense sampling by the static
// query.

#include <fcl/config.h>

#if FCL_HAVE_OCTOMAP
#include <cstdio>
#include <random>

#include "continuous/moving_meshes.h"

namespace kios::testing {
namespace {

using Octree = std::shared_ptr<fcl::OcTreed>;

/// The cells of `resolution` at these points are occupied.
Octree octree(double resolution, const std::vector<Vector3d>& points) {
  const auto tree = std::make_shared<octomap::OcTree>(resolution);
  for (const Vector3d& p : points) {
    tree->updateNode(octomap::point3d(static_cast<float>(p.x()), static_cast<float>(p.y()),
                                      static_cast<float>(p.z())),
                     true);
  }
  tree->updateInnerOccupancy();
  return std::make_shared<fcl::OcTreed>(std::shared_ptr<const octomap::OcTree>(tree));
}

TEST(OctreeContact, KnownTimes) {
  const auto box = kiosModel(scenes::subdividedBox({2, 2, 2}, 2));
  const Octree cells = octree(0.5, {{0.1, 0.1, 0.1}, {0.1, 3.1, 0.1}});  // [0, 0.5]^3, and beside
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

TEST(OctreeContact, RandomMotionsAgreeWithDenseSampling) {
  std::mt19937_64 random(11);
  std::uniform_real_distribution<double> u(-1, 1);
  const auto point = [&](double far) {
    return Vector3d(far * u(random), far * u(random), far * u(random));
  };
  std::vector<Vector3d> points;
  for (int i = 0; i < 60; ++i) points.push_back(point(2));
  const Octree cells = octree(0.1, points);
  const std::shared_ptr<Modeld> meshes[] = {kiosModel(scenes::bumpyTorus(200)),
                                            kiosModel(scenes::subdividedBox({0.4, 0.3, 0.02}, 2))};
  Outcomes outcomes;
  for (auto type : kMotionTypes) {
    for (int i = 0; i < 60; ++i) {
      const auto motion = [&]() -> Motion {
        const auto pose = [&] {
          const Vector3d p = point(3);
          return at(p.x(), p.y(), p.z(), 3 * u(random), point(1));
        };
        if (type != fcl::CCDM_SPLINE) return motionOf(type, pose(), pose());
        return std::make_shared<fcl::SplineMotion<double>>(point(4), point(4), point(4), point(4),
                                                           point(6), point(6), point(6), point(6));
      };
      const auto& mesh = *meshes[i % 2];
      const Motion a = motion(), b = motion();
      const double toc_err = 1e-5;
      const auto result = askBoth(mesh, *a, *cells, *b, toc_err, &outcomes.counts);
      const Sampling sampling = {mesh, *a, *cells, *b};
      const double first = sampling.firstOf(300);
      ++outcomes.queries;
      if (!result.is_collide) {
        EXPECT_EQ(first, 2);
        continue;
      }
      ++outcomes.hits;
      const double toc = result.time_of_contact;
      EXPECT_LE(toc, first);
      EXPECT_TRUE(first <= toc + toc_err || sampling.touchWithin(toc, toc_err)) << type << " " << i;
    }
  }
  outcomes.expectBothKinds();
}

}  // namespace
}  // namespace kios::testing
#endif  // FCL_HAVE_OCTOMAP
