// SPDX-FileCopyrightText: 2026 The fcl_kios authors
// SPDX-License-Identifier: BSD-3-Clause
//
// Scales, offsets, degenerate triangles, refits, and motions that keep close without touching.

#include <cmath>

#include "continuous/moving_meshes.h"
#include "scenes/cad_shapes.h"

namespace kios::testing {
namespace {

Transform3d scaledPose(Transform3d X, double scale) {
  X.translation() *= scale;
  return X;
}

// Times of contact don't change with the unit of length.
TEST(HardCases, AnyScale) {
  const Mesh torus = scenes::bumpyTorus(200), box = scenes::subdividedBox({1, 1, 1}, 2);
  for (auto type : kMotionTypes) {
    double expected = -1;
    for (double scale : {1.0, 1e-6, 1e6, 1e-30, 1e30, 0x1p300, 0x1p-400, 0x1p-490}) {
      const Pair pair(transformed(torus, scale, Vector3d::Zero()),
                      transformed(box, scale, Vector3d::Zero()));
      fcl::ContinuousCollisionResultd result;
      ContinuousCounts counts;
      firstContact(*pair.a, at(0, 0, 0), at(0, 0, 0, 1), *pair.b, scaledPose(at(5, 1, 2), scale),
                   scaledPose(at(-4, 0, 0.2, 0.4), scale), requestFor(type, 1e-6), result, &counts);
      EXPECT_TRUE(result.is_collide) << scale << " type " << type << " steps " << counts.steps;
      if (expected < 0) expected = result.time_of_contact;
      EXPECT_NEAR(result.time_of_contact, expected, 1e-6) << scale;
      EXPECT_LT(counts.steps, 300) << scale;
    }
  }
}

// Points that pass each other, or meet halfway, where squares of lengths underflow.
TEST(HardCases, PointsPassAtAnyScale) {
  const Mesh point = scenes::singleTriangle({0, 0, 0}, {0, 0, 0}, {0, 0, 0});
  const Pair pair(point, point);
  for (auto type : kMotionTypes) {
    for (int e : {-20, -300, -420, -480, -490, -500, -510, -520}) {
      const double clearance = std::ldexp(1, e);
      for (double way : {0.125, 1.0, 8.0, 128.0, 0x1p20}) {
        for (const Vector3d& direction :
             {Vector3d(1, 0, 0), Vector3d(0, 1, 0), Vector3d(2, -3, 0)}) {
          const auto from = [&](double gap, double to) {
            const Vector3d x = clearance * (to * way * direction + Vector3d(0, 0, gap));
            return at(x.x(), x.y(), x.z());
          };
          fcl::ContinuousCollisionResultd result;
          const auto request = requestFor(type, 1e-6);
          firstContact(*pair.a, at(0, 0, 0), at(0, 0, 0), *pair.b, from(1, -1), from(1, 1), request,
                       result);
          EXPECT_FALSE(result.is_collide) << "2^" << e << " way " << way << " type " << type;
          firstContact(*pair.a, from(0, 1), from(0, -1), *pair.b, from(0, -1), from(0, 1), request,
                       result);
          EXPECT_TRUE(result.is_collide) << "2^" << e << " way " << way << " type " << type;
          EXPECT_LE(result.time_of_contact, 0.5) << "2^" << e << " way " << way;
          // Contact may be told 2^-529 before it, which is more than toc_err at 2^-510.
          const double speed = 4 * clearance * way;
          EXPECT_GE(result.time_of_contact, 0.5 - 1e-6 - 0x1p-529 / speed)
              << "2^" << e << " way " << way;
        }
      }
    }
  }
}

// A wheel that turns at a small clearance to a wall: many turns, bounded work.
TEST(HardCases, ASpinningWheelKeepsClear) {
  const Mesh wheel = scenes::uvSphere(1, 6, 12), wall = scenes::subdividedBox({0.2, 4, 4}, 2);
  const Pair pair(wheel, wall);
  const Vector3d z = Vector3d::UnitZ(), o = Vector3d::Zero();
  const fcl::SplineMotion<double> spin(o, o, o, o, -6 * z, 0 * z, 6 * z, 12 * z);
  for (double gap : {1e-2, 1e-3}) {
    const Motion still = motionOf(fcl::CCDM_TRANS, at(1.1 + gap, 0, 0), at(1.1 + gap, 0, 0));
    const Answer answer = ask(pair, spin, *still, 1e-4);
    EXPECT_FALSE(answer.result.is_collide) << gap;
    EXPECT_LT(answer.counts.steps, 3000) << gap;
    expectRight({*pair.a, spin, *pair.b, *still}, answer.result, 1e-4, 500, 1e-7);
    std::printf("wheel, gap %g: %lld steps, %lld volume tests, %lld leaf tests\n", gap,
                answer.counts.steps, answer.counts.volume_tests, answer.counts.leaf_tests);
  }
}

// Models that aren't occupied touch nothing, as in collide().
TEST(HardCases, FreeModels) {
  const auto a = kiosModel(scenes::subdividedBox({1, 1, 1}, 1));
  const auto b = kiosModel(scenes::subdividedBox({1, 1, 1}, 1));
  b->cost_density = b->threshold_occupied / 2;
  ASSERT_FALSE(b->isOccupied());
  fcl::ContinuousCollisionResultd result;
  firstContact(*a, at(0, 0, 0), at(0, 0, 0), *b, at(4, 0, 0), at(-4, 0, 0),
               requestFor(fcl::CCDM_TRANS), result);
  EXPECT_FALSE(result.is_collide);
}

// Two soups amid each other, all of whose nodes overlap: no step is cheap, and none may be cut down
// to nothing for it.
TEST(HardCases, CostlyStepsReachTheEnd) {
  const Mesh soup = scenes::randomSoup(2000, 1, 1e-3, 2e-3, 5);
  const Pair pair(soup, scenes::moved(at(0, 0, 0, 0.7, {1, 2, 3}), soup));
  const Motion rest = motionOf(fcl::CCDM_TRANS, at(0, 0, 0), at(0, 0, 0));
  const double distance = Sampling{*pair.a, *rest, *pair.b, *rest}.distanceAt(0);
  ASSERT_GT(distance, 0);
  for (auto type : {fcl::CCDM_TRANS, fcl::CCDM_SPLINE}) {
    for (const double part : {1e-6, 1e-3, 0.1}) {
      const auto still = motionOf(type, at(0, 0, 0), at(0, 0, 0));
      const auto moves = motionOf(type, at(0, 0, 0), at(part * distance, 0, 0));
      const Answer answer = ask(pair, *still, *moves, 1e-3);
      EXPECT_FALSE(answer.result.is_collide) << type << " " << part;
      EXPECT_LT(answer.counts.steps, 50);
    }
  }
}

}  // namespace
}  // namespace kios::testing
