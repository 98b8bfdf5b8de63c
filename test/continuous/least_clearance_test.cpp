// SPDX-FileCopyrightText: 2026 The fcl_kios authors
// SPDX-License-Identifier: BSD-3-Clause
//
// The least clearance of two bodies on FCL's motions: known minima, and dense samples.

#include <cmath>
#include <limits>

#include "continuous/moving_meshes.h"
#include "fcl/expect_refused.h"
#include "fcl_kios/motion.h"

namespace kios::testing {
namespace {

using Geometry = std::shared_ptr<fcl::CollisionGeometryd>;

double distanceAt(const Geometry& a, const fcl::MotionBased& motion_a, const Geometry& b,
                  const fcl::MotionBased& motion_b, double t) {
  fcl::CollisionResultd contacts;
  const Transform3d X_WA = poseAt(motion_a, t), X_WB = poseAt(motion_b, t);
  if (fcl::collide(a.get(), X_WA, b.get(), X_WB, fcl::CollisionRequestd(), contacts) > 0) return 0;
  fcl::DistanceResultd result;
  return fcl::distance(a.get(), X_WA, b.get(), X_WB, fcl::DistanceRequestd(), result);
}

// Nothing that users ask for ends by the budget that they don't name.
TEST(LeastClearance, OfLargeMeshesThatTurn) {
  const Geometry torus = kiosModel(scenes::bumpyTorus(4000));
  const fcl::Vector3d axis = fcl::Vector3d(1, 2, 0.5).normalized();
  const Transform3d turned = fcl::AngleAxisd(2.5, axis) * Transform3d::Identity();
  for (const double z : {3.2, 3.6}) {
    const Motion turning = motionOf(fcl::CCDM_LINEAR, at(0, 0, 0), turned),
                 passing =
                     motionOf(fcl::CCDM_LINEAR, at(0.5, 0, z), at(-0.4, 0.3, z - 0.3) * turned);
    const RangeResult result = leastClearance(*torus, turning.get(), *torus, passing.get());
    EXPECT_TRUE(result.complete);
    EXPECT_LE(result.queries, RangeRequest().max_queries / 20);
  }
}

// A box passes another one, and a ball; they are nearest side by side.
TEST(LeastClearance, OfWhatPassesBy) {
  const Geometry box = kiosModel(scenes::subdividedBox({1, 1, 1}, 4)),
                 ball = std::make_shared<fcl::Sphered>(0.5);
  for (const Geometry& other : {box, ball}) {
    for (const auto type : kMotionTypes) {
      const Motion still = motionOf(type, at(0, 0, 0), at(0, 0, 0)),
                   passing = motionOf(type, at(-3, 1.2, 0), at(4, 1.2, 0));
      RangeRequest request;
      request.abs_err = 1e-3;
      request.rel_err = 0;
      for (const bool swapped : {false, true}) {
        const RangeResult result =
            swapped ? leastClearance(*other, passing.get(), *box, still.get(), request)
                    : leastClearance(*box, still.get(), *other, passing.get(), request);
        EXPECT_TRUE(result.complete);
        EXPECT_LE(result.lower, 0.2);
        EXPECT_GE(result.upper, 0.2 - 1e-12);
        EXPECT_LE(result.upper - result.lower, 1.001e-3);
        ASSERT_EQ(result.at.size(), 1U);
        EXPECT_NEAR((result.point_a - result.point_b).norm(), result.upper, 1e-9);
        EXPECT_NEAR(std::abs(result.point_b.y() - result.point_a.y()), 0.2, 1e-3);
        EXPECT_EQ(result.point_b.y() > result.point_a.y(), !swapped);
      }
      request.ceiling = 0.1;
      const RangeResult beyond = leastClearance(*box, still.get(), *other, passing.get(), request);
      EXPECT_TRUE(beyond.complete);
      EXPECT_EQ(beyond.lower, 0.1);
      EXPECT_EQ(beyond.upper, std::numeric_limits<double>::infinity());
      const Motion through = motionOf(type, at(-3, 0.9, 0), at(4, 0.9, 0));
      const RangeResult contact = leastClearance(*box, still.get(), *other, through.get());
      EXPECT_TRUE(contact.complete);
      EXPECT_EQ(contact.lower, 0);
      EXPECT_EQ(contact.upper, 0);
      EXPECT_EQ(distanceAt(box, *still, other, *through, contact.at.at(0)), 0);
    }
  }
}

TEST(LeastClearance, NoSampleIsBelow) {
  RandomPoses random(4);
  const Geometry torus = kiosModel(scenes::bumpyTorus(300));
  const Geometry others[] = {torus, std::make_shared<fcl::Boxd>(0.8, 0.5, 0.6),
                             std::make_shared<fcl::Capsuled>(0.2, 1.5),
                             std::make_shared<fcl::Ellipsoidd>(0.6, 0.4, 0.3)};
  int clear = 0;
  for (int trial = 0; trial < 48; ++trial) {
    const auto type = kMotionTypes[trial % 4];
    const Geometry& other = others[trial / 4 % 4];
    const Motion a = motionOf(type, random.pose(1), random.pose(1));
    const Transform3d X_0 = at(3, 0, 0.4) * random.pose(0.6),
                      X_1 = at(3, 0.3, 0) * random.pose(0.6);
    const Motion b = motionOf(type, X_0, X_1);
    RangeRequest request;
    request.rel_err = 0.05;
    const RangeResult result = leastClearance(*torus, a.get(), *other, b.get(), request);
    double least = std::numeric_limits<double>::infinity();
    for (int i = 0; i <= 300; ++i) {
      least = std::min(least, distanceAt(torus, *a, other, *b, i / 300.0));
    }
    SCOPED_TRACE(trial);
    EXPECT_TRUE(result.complete);
    EXPECT_GE(least, result.lower - 1e-9);
    EXPECT_LE(result.upper, least + std::max(1e-4, 0.05 * least));
    EXPECT_LE(result.upper - result.lower, std::max(1e-4, 0.05 * result.upper) * (1 + 1e-9));
    EXPECT_LE(distanceAt(torus, *a, other, *b, result.at.at(0)), result.upper + 1e-9);
    clear += result.upper > 0 ? 1 : 0;
    request.max_queries = trial;
    request.rel_err = 0;
    request.abs_err = 1e-12;
    const RangeResult cut = leastClearance(*torus, a.get(), *other, b.get(), request);
    EXPECT_LE(cut.lower, cut.upper);
    EXPECT_GE(least, cut.lower - 1e-9);
    EXPECT_GE(cut.upper, result.lower - 1e-9);
  }
  EXPECT_GT(clear, 10);
}

// At the distance itself, to rounding, a ceiling proves nothing, moving or still; of shapes as
// their kernels' errors allow.
TEST(LeastClearance, CeilingsAtTheDistance) {
  const double inf = std::numeric_limits<double>::infinity();
  const Geometry box = kiosModel(scenes::subdividedBox({1, 1, 1}, 4));
  const auto points = std::make_shared<std::vector<fcl::Vector3d>>();
  for (int i = 0; i < 8; ++i) {
    points->emplace_back(i & 1 ? 0.5 : -0.5, i & 2 ? 0.5 : -0.5, i & 4 ? 0.5 : -0.5);
  }
  const Geometry others[] = {
      box, std::make_shared<fcl::Sphered>(0.5), std::make_shared<fcl::Ellipsoidd>(0.4, 0.5, 0.001),
      std::make_shared<fcl::Convexd>(points, 0, std::make_shared<std::vector<int>>()),
      std::make_shared<fcl::Halfspaced>(fcl::Vector3d(0, -1, 0), 0.5)};
  for (const Geometry& other : others) {
    const double y = 1.2;
    for (const double way : {0.0, 2.0}) {
      const Motion still = motionOf(fcl::CCDM_LINEAR, at(0, 0, 0), at(0, 0, 0)),
                   passing = motionOf(fcl::CCDM_LINEAR, at(-way, y, 0), at(way, y, 0));
      const double least = distanceAt(box, *still, other, *passing, 0.5);
      for (const double ceiling :
           {-1.0, 0.0, 0.5 * least, least * (1 - 1e-11), least, least * (1 + 1e-11), inf}) {
        RangeRequest request;
        request.ceiling = ceiling;
        const RangeResult result =
            leastClearance(*box, still.get(), *other, passing.get(), request);
        SCOPED_TRACE(std::to_string(ceiling) + " of " + std::to_string(least));
        EXPECT_LE(result.lower, least);
        EXPECT_GE(result.upper, least - 1e-6);
        EXPECT_GE(result.lower, std::min(ceiling, least) - 1e-2);
        const bool narrow = result.lower >= std::min(ceiling, result.upper - 0.011);
        EXPECT_TRUE(narrow || !result.complete);
        EXPECT_TRUE(result.complete || std::abs(ceiling - least) < 1e-9);
        if (other == others[3] && result.complete) {  // known to 2^-28
          EXPECT_TRUE(std::abs(ceiling - least) > 1e-9);
        }
      }
    }
  }
}

// What was seen is narrow enough; nothing need be proven.
TEST(LeastClearance, NearerThanTheErrorAllAlong) {
  const Geometry box = kiosModel(scenes::subdividedBox({1, 1, 1}, 4)),
                 ball = std::make_shared<fcl::Sphered>(0.5);
  for (const double gap : {1e-13, 1e-9, 5e-5}) {
    for (const Geometry& other : {box, ball}) {
      const Motion still = motionOf(fcl::CCDM_LINEAR, at(0, 0, 0), at(0, 0, 0)),
                   along = motionOf(fcl::CCDM_LINEAR, at(-0.4, 1 + gap, 0), at(0.4, 1 + gap, 0));
      const RangeResult result = leastClearance(*box, still.get(), *other, along.get());
      EXPECT_TRUE(result.complete);
      EXPECT_LE(result.lower, gap);
      EXPECT_LE(result.upper, 2e-4);
      EXPECT_LE(result.queries, 10);
    }
  }
}

TEST(LeastClearance, RefusesWhatIsNotServed) {
  const Geometry ball = std::make_shared<fcl::Sphered>(0.5),
                 box = kiosModel(scenes::subdividedBox({1, 1, 1}, 1));
  const Motion still = motionOf(fcl::CCDM_LINEAR, at(0, 0, 0), at(0, 0, 0));
  expectRefused([&] { leastClearance(*ball, still.get(), *ball, still.get()); }, "Sphere");
  expectRefused([&] { leastClearance(*ball, nullptr, *box, still.get()); }, "motion");
  RangeRequest wrong;
  wrong.abs_err = std::nan("");
  expectRefused([&] { leastClearance(*ball, still.get(), *box, still.get(), wrong); }, "abs_err");
}

}  // namespace
}  // namespace kios::testing
