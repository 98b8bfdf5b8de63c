// SPDX-FileCopyrightText: 2026 The fcl_kios authors
// SPDX-License-Identifier: BSD-3-Clause
//
// FCL's searches made by the preloaded library are FCL's own, to the bit.
#include "preload/fcl_search.h"

#include <cmath>
#include <limits>

#include <gtest/gtest.h>
#include "preload/fcl_meshes.h"

namespace kios::preload {
namespace {

constexpr double kInfinity = std::numeric_limits<double>::infinity();

template <typename BV>
class FclSearch : public ::testing::Test {};
using Collided = ::testing::Types<fcl::OBBd, fcl::kIOSd, fcl::OBBRSSd>;
TYPED_TEST_SUITE(FclSearch, Collided);

template <typename BV>
bool rootsOverlapInFcl(const fcl::BVHModel<BV>& a, const Pose& X_WA, const fcl::BVHModel<BV>& b,
                       const Pose& X_WB) {
  typename FclNodes<BV>::Collide node;
  CollisionResult unused;
  fcl::detail::initialize(node, a, X_WA, b, X_WB, CollisionRequest(), unused);
  return !node.BVTesting(0, 0);
}

// Poses where the roots just touch, and those a few units in the last place away.
TYPED_TEST(FclSearch, RootsAreRejectedAsInFcl) {
  const auto a = build<TypeParam>(torus(12, 8)), b = build<TypeParam>(torus(9, 7, 0.7));
  std::mt19937 random(1);
  int flips = 0;
  for (int i = 0; i < 400; ++i) {
    const Pose X_WA = randomPose(random, 0, 100);
    Pose X_WB = X_WA * randomPose(random, 0.1, 0.2);
    const fcl::Vector3d direction = (X_WB.translation() - X_WA.translation()).normalized();
    const auto overlap = [&](double t) {
      X_WB.translation() = X_WA.translation() + t * direction;
      const bool ours = rootsOverlap(*a, X_WA, *b, X_WB);
      EXPECT_EQ(ours, rootsOverlapInFcl(*a, X_WA, *b, X_WB));
      return ours;
    };
    double near = 0, far = 10;
    while (std::nextafter(near, far) < far) {
      const double middle = (near + far) / 2;
      (overlap(middle) ? near : far) = middle;
    }
    flips += overlap(near) != overlap(far) ? 1 : 0;
    double t = near;
    for (int k = 0; k < 20; ++k) overlap(t = std::nextafter(t, k % 2 == 0 ? far + 1 : far + 2));
  }
  EXPECT_EQ(flips, 400);
}

void expectEqual(const CollisionResult& ours, const CollisionResult& fcls) {
  ASSERT_EQ(ours.numContacts(), fcls.numContacts());
  for (std::size_t i = 0; i < ours.numContacts(); ++i) {
    const auto &mine = ours.getContact(i), &theirs = fcls.getContact(i);
    ASSERT_EQ(mine.o1, theirs.o1);
    ASSERT_EQ(mine.o2, theirs.o2);
    ASSERT_EQ(mine.b1, theirs.b1);
    ASSERT_EQ(mine.b2, theirs.b2);
    ASSERT_EQ(mine.pos, theirs.pos);
    ASSERT_EQ(mine.normal, theirs.normal);
    ASSERT_EQ(mine.penetration_depth, theirs.penetration_depth);
  }
}

TYPED_TEST(FclSearch, CollidesAsFcl) {
  const auto a = build<TypeParam>(torus(14, 9)), b = build<TypeParam>(torus(11, 8, 0.8));
  std::mt19937 random(2);
  int ended = 0, found = 0;
  for (int i = 0; i < 600; ++i) {
    const Pose X_WA = randomPose(random, 0, 2), X_WB = X_WA * randomPose(random, 0.2, 2.6);
    const CollisionRequest request(i % 3 == 0 ? 1 : 9, true);
    CollisionResult ours, limited, fcls;
    const fcl::CollisionGeometryd *const of_a = a.get(), *const of_b = b.get();
    fcl::collide(of_a, X_WA, of_b, X_WB, request, fcls);
    if (!rootsOverlap(*a, X_WA, *b, X_WB)) {
      ASSERT_EQ(fcls.numContacts(), 0u);
      continue;
    }
    ASSERT_TRUE(collideByFcl(*a, X_WA, *b, X_WB, request, ours, kInfinity).done);
    expectEqual(ours, fcls);
    const double limit = 100.0 * (i % 50);
    if (collideByFcl(*a, X_WA, *b, X_WB, request, limited, limit).done) {
      expectEqual(limited, fcls);
      found += fcls.isCollision() ? 1 : 0;
    } else {
      ASSERT_EQ(limited.numContacts(), 0u);
      ++ended;
    }
  }
  EXPECT_GT(ended, 50);
  EXPECT_GT(found, 50);
}

template <typename BV>
class FclDistance : public ::testing::Test {};
using Measured = ::testing::Types<fcl::RSSd, fcl::kIOSd, fcl::OBBRSSd>;
TYPED_TEST_SUITE(FclDistance, Measured);

TYPED_TEST(FclDistance, MeasuresAsFcl) {
  const auto a = build<TypeParam>(torus(14, 9)), b = build<TypeParam>(torus(11, 8, 0.8));
  std::mt19937 random(3);
  int ended = 0, done = 0;
  const auto expectSame = [](const DistanceResult& ours, const DistanceResult& fcls) {
    ASSERT_EQ(ours.min_distance, fcls.min_distance);
    ASSERT_EQ(ours.o1, fcls.o1);
    ASSERT_EQ(ours.o2, fcls.o2);
    ASSERT_EQ(ours.b1, fcls.b1);
    ASSERT_EQ(ours.b2, fcls.b2);
    if (!ours.o1) return;
    ASSERT_EQ(ours.nearest_points[0], fcls.nearest_points[0]);
    ASSERT_EQ(ours.nearest_points[1], fcls.nearest_points[1]);
  };
  for (int i = 0; i < 300; ++i) {
    const Pose X_WA = randomPose(random, 0, 2), X_WB = X_WA * randomPose(random, 1, 5);
    const DistanceRequest request(true, false, i % 2, i % 3);
    DistanceResult ours, limited, fcls;
    if (i % 4 == 0) ours.min_distance = limited.min_distance = fcls.min_distance = 1;
    const fcl::CollisionGeometryd *const of_a = a.get(), *const of_b = b.get();
    fcl::distance(of_a, X_WA, of_b, X_WB, request, fcls);
    ASSERT_TRUE(distanceByFcl(*a, X_WA, *b, X_WB, request, ours, kInfinity).done);
    expectSame(ours, fcls);
    const double before = limited.min_distance;
    if (distanceByFcl(*a, X_WA, *b, X_WB, request, limited, 2000.0 * (i % 80)).done) {
      expectSame(limited, fcls);
      ++done;
    } else {
      ASSERT_EQ(limited.min_distance, before);
      ASSERT_EQ(limited.o1, nullptr);
      ++ended;
    }
  }
  EXPECT_GT(ended, 50);
  EXPECT_GT(done, 50);
}

}  // namespace
}  // namespace kios::preload
