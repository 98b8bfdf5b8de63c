// SPDX-FileCopyrightText: 2026 The fcl_kios authors
// SPDX-License-Identifier: BSD-3-Clause
//
// What findClashes() says of solids of several components, surfaces, parts without volume, equal
// parts, ignored ones and bad input, by cases that are known.
#include <limits>

#include <fcl/geometry/geometric_shape_to_BVH_model.h>
#include <fcl/math/bv/OBBRSS.h>
#include "fcl/expect_refused.h"
#include "scene/clash_parts.h"

namespace kios::testing {
namespace {

TEST(ClashRules, ComponentsCountOneByOne) {
  const auto ball = solidOf(scenes::icosphere(1, 2));
  const auto two =
      solidOf(scenes::merged({transformed(scenes::icosphere(0.2, 1), 1, {0.3, 0, 0}),
                              transformed(scenes::icosphere(0.2, 1), 1, {-0.3, 0, 0})}));
  const auto hollow = solidOf(shell(3, 2, 2));
  const auto filled = solidOf(shell(3, 0.5, 2));
  EXPECT_EQ(only({partOf(ball, kHere, 0), partOf(two, kHere, 1)}).status, ClashStatus::kInside);
  // One of two lies in the ball.
  const ClashResult half = only({partOf(ball, kHere, 0), partOf(two, at(1.2, 0, 0), 1)});
  EXPECT_EQ(half.status, ClashStatus::kOverlap);
  EXPECT_GT(half.lower, 0);
  EXPECT_TRUE(findClashes({partOf(hollow, kHere, 0), partOf(ball, kHere, 1)}).empty());
  // The cavity's wall lies in the ball, and so the ball isn't in the shell.
  EXPECT_EQ(only({partOf(filled, kHere, 0), partOf(ball, kHere, 1)}).status, ClashStatus::kOverlap);
  // A component of another within the ball is no cavity; one that cuts itself may leave some free.
  const auto nested = solidOf(scenes::merged({scenes::icosphere(3, 2), scenes::icosphere(0.5, 1)}));
  EXPECT_EQ(only({partOf(nested, kHere, 0), partOf(ball, kHere, 1)}).status, ClashStatus::kInside);
  EXPECT_EQ(only({partOf(ball, kHere, 0), partOf(nested, kHere, 1)}).status, ClashStatus::kInside);
  Mesh bow = scenes::icosphere(0.5, 1);  // whose smaller lobe is inside out
  for (fcl::Vector3d& p : bow.vertices) p.y() *= p.x() + 0.3;
  const auto crossed = solidOf(scenes::merged({scenes::icosphere(3, 2), bow}));
  EXPECT_EQ(only({partOf(crossed, kHere, 0), partOf(ball, kHere, 1)}).status,
            ClashStatus::kOverlap);
  EXPECT_EQ(
      only({partOf(ball, at(0.1, 0, 0), 0), partOf(solidOf(scenes::icosphere(0.5, 1)), kHere, 1)})
          .status,
      ClashStatus::kInside);
}

TEST(ClashRules, SurfacesAreDecidedByCornersAlone) {
  const double inf = std::numeric_limits<double>::infinity();
  const auto ball = solidOf(scenes::icosphere(1, 3));
  const auto fine = modelOf(scenes::sheet(4, 4, 40, 40, 0)),
             small = modelOf(scenes::sheet(1, 1, 2, 2, 0)),
             coarse = modelOf(scenes::sheet(40, 40, 1, 1, 0));
  const ClashResult through = only({partOf(fine, kHere, 0), partOf(ball, kHere, 1)});
  EXPECT_EQ(through.status, ClashStatus::kOverlap);
  EXPECT_TRUE(through.decided);
  EXPECT_NEAR(through.lower, 1, 0.1);
  EXPECT_EQ(through.upper, inf);
  EXPECT_LT(toVector(through.point_a).norm(), 0.1);
  EXPECT_NEAR(toVector(through.point_b).norm(), 1, 0.05);
  const ClashResult inside = only({partOf(ball, kHere, 0), partOf(small, kHere, 1)});
  EXPECT_EQ(inside.status, ClashStatus::kInside);
  EXPECT_TRUE(inside.decided);
  // No corner is in the ball, nor does one of two surfaces have an inside.
  for (const auto& other : {ball, coarse}) {
    const ClashResult unknown =
        only({partOf(coarse, kHere, 0),
              partOf(other, other == ball ? at(0.1, 0, 0.1) : at(0, 1, 0), 1)});
    EXPECT_EQ(unknown.status, ClashStatus::kOverlap);
    EXPECT_FALSE(unknown.decided);
    EXPECT_TRUE(unknown.deep);
    EXPECT_EQ(unknown.lower, 0);
    EXPECT_EQ(unknown.upper, inf);
  }
  ClashRequest near;
  near.clearance = 0.2;
  const ClashResult apart = only({partOf(fine, at(0, 0, 1.1), 0), partOf(ball, kHere, 1)}, near);
  EXPECT_EQ(apart.status, ClashStatus::kClearance);
  EXPECT_NEAR(apart.lower, 0.1, 0.01);
}

// Two sides that are one: closed, and so a solid, without volume.
TEST(ClashRules, SolidsWithoutVolumeTouchEachOther) {
  const Mesh sheet = scenes::sheet(2, 2, 2, 2, 0);
  const auto flat = solidOf(scenes::merged({sheet, flipped(sheet)}));
  const auto block = solidOf(scenes::subdividedBox({4, 4, 4}, 2));
  const fcl::Transform3d upright(Eigen::AngleAxisd(1.5, fcl::Vector3d(0.3, 0.8, 0.1).normalized()));
  for (const fcl::Transform3d& X : {upright, at(0.3, 0.1, 0)}) {
    const ClashResult across = only({partOf(flat, kHere, 0), partOf(flat, X, 1)});
    EXPECT_EQ(across.status, ClashStatus::kTouch);
    EXPECT_TRUE(across.decided);
  }
  EXPECT_EQ(only({partOf(flat, kHere, 0), partOf(flat, kHere, 1)}).status, ClashStatus::kDuplicate);
  EXPECT_EQ(only({partOf(flat, kHere, 0), partOf(block, kHere, 1)}).status, ClashStatus::kInside);
  const ClashResult let_in = only({partOf(flat, at(2.5, 0, 0), 0), partOf(block, kHere, 1)});
  EXPECT_EQ(let_in.status, ClashStatus::kOverlap);
  EXPECT_TRUE(let_in.decided);
  EXPECT_LE(let_in.lower, 0.5);
  EXPECT_GE(let_in.upper, 0.5 - 1e-12);
  EXPECT_EQ(only({partOf(flat, at(0, 0, 2), 0), partOf(block, kHere, 1)}).status,
            ClashStatus::kTouch);
}

TEST(ClashRules, NoPairTakesMorePiecesThanItMay) {
  const auto ball = solidOf(scenes::icosphere(1, 3));
  ClashRequest request;
  request.touch = 0.3;
  request.max_pieces = 0;
  const Parts parts = {partOf(ball, kHere, 0), partOf(ball, at(1.69, 0, 0), 1)};
  const ClashResult unknown = only(parts, request);
  EXPECT_EQ(unknown.status, ClashStatus::kOverlap);
  EXPECT_FALSE(unknown.decided);
  EXPECT_LE(unknown.lower, 0.3);
  EXPECT_GE(unknown.upper, 0.3);
  request.max_pieces = 100000;
  EXPECT_TRUE(only(parts, request).decided);
  request.max_pieces = -1;
  EXPECT_THROW(findClashes(parts, request), std::invalid_argument);
}

TEST(ClashRules, DuplicatesAreFoundByContent) {
  const Mesh mesh = scenes::bumpyTorus(400);
  const auto model = solidOf(mesh);
  const ClashResult shared = only({partOf(model, at(1, 2, 3), 0), partOf(model, at(1, 2, 3), 1)});
  EXPECT_EQ(shared.status, ClashStatus::kDuplicate);
  EXPECT_EQ(shared.upper, 0);
  // Another model of the same content; one whose vertices are where the pose took the other's.
  EXPECT_EQ(only({partOf(model, kHere, 0), partOf(modelOf(mesh), kHere, 1)}).status,
            ClashStatus::kDuplicate);
  const auto moved = solidOf(transformed(mesh, 1, {1, 2, 3}));
  const ClashResult near = only({partOf(model, at(1, 2, 3), 0), partOf(moved, kHere, 1)});
  EXPECT_EQ(near.status, ClashStatus::kDuplicate);
  EXPECT_TRUE(near.decided);
  ClashRequest request;
  request.touch = 0.01;
  const ClashResult shifted =
      only({partOf(model, kHere, 0), partOf(model, at(0, 0, 0.009), 1)}, request);
  EXPECT_EQ(shifted.status, ClashStatus::kDuplicate);
  EXPECT_LE(shifted.lower, 0.009);
  EXPECT_GE(shifted.upper, 0.009);
  EXPECT_EQ(only({partOf(model, kHere, 0), partOf(model, at(0, 0, 0.011), 1)}, request).status,
            ClashStatus::kOverlap);
  const auto tiny = modelOf(transformed(mesh, 1e-200, {0, 0, 0}));
  request.touch = 1e-203;
  EXPECT_NE(
      findClashes({partOf(tiny, kHere, 0), partOf(tiny, at(0, 0, 1e-201), 1)}, request)[0].status,
      ClashStatus::kDuplicate);
  request.touch = 0;
  EXPECT_EQ(only({partOf(model, kHere, 0), partOf(model, kHere, 1)}, request).status,
            ClashStatus::kDuplicate);
  const auto box = solidOf(scenes::subdividedBox({1, 1, 1}, 2));
  const ClashResult flush = only({partOf(box, kHere, 0), partOf(box, at(1, 0, 0), 1)}, request);
  EXPECT_EQ(flush.status, ClashStatus::kTouch);
  EXPECT_TRUE(flush.decided);
}

/// What a refusal of such a shape names.
TEST(ClashRules, MeshesThatFclMakesOfShapesAreParts) {
  const auto here = fcl::Transform3d::Identity();
  std::vector<std::shared_ptr<Modeld>> meshes;
  const auto next = [&]() -> Modeld& { return *meshes.emplace_back(std::make_shared<Modeld>()); };
  fcl::generateBVHModel(next(), fcl::Sphered(1), here, 24, 12);
  fcl::generateBVHModel(next(), fcl::Ellipsoidd(1, 1, 1), here, 24, 12);
  fcl::generateBVHModel(next(), fcl::Cylinderd(1, 2), here, 24, 2);
  fcl::generateBVHModel(next(), fcl::Coned(1, 2), here, 24, 2);
  ClashPart wall;
  wall.geometry = std::make_shared<fcl::Boxd>(1, 9, 9);
  for (const auto& mesh : meshes) {
    ASSERT_NO_THROW(markSolid(*mesh));
    const ClashResult clash = only({wall, partOf(mesh, at(-1.4, 0, 0), 1)});
    EXPECT_EQ(clash.status, ClashStatus::kOverlap);
    EXPECT_LE(clash.lower, 0.1 + 1e-12);
    EXPECT_GE(clash.upper, 0.09);
  }
}

TEST(ClashRules, IgnoredPairsAndGroupsAreLeftOut) {
  const auto model = solidOf(scenes::icosphere(1, 1));
  Parts parts;
  for (std::size_t i = 0; i < 4; ++i) {
    parts.push_back(partOf(model, at(0.2 * static_cast<double>(i), 0, 0), i));
    parts.back().group = static_cast<int>(i) / 2;
  }
  ClashRequest request;
  EXPECT_EQ(findClashes(parts, request).size(), 6u);
  request.ignored = {{"part 2", "part 0"}, {"part 0", "part 1"}};
  const auto left = byPair(findClashes(parts, request));
  EXPECT_EQ(left.size(), 4u);
  EXPECT_EQ(left.count({0, 1}) + left.count({0, 2}), 0u);
  request.between_groups = true;
  const auto between = byPair(findClashes(parts, request));
  EXPECT_EQ(between.size(), 3u);
  EXPECT_EQ(between.count({2, 3}), 0u);
  EXPECT_TRUE(findClashes({}).empty());
}

TEST(ClashRules, CrowdsAtOnePlaceAreRefusedAtOnce) {
  const auto model = solidOf(scenes::icosphere(1, 1));
  Parts parts;
  for (std::size_t i = 0; i < 5000; ++i) parts.push_back(partOf(model, kHere, i));
  expectRefused([&] { findClashes(parts); }, "max_pairs");
}

TEST(ClashRules, BadInputIsRefusedByName) {
  const auto model = solidOf(scenes::icosphere(1, 1));
  const auto refused = [&](const std::string& words,
                           const std::function<void(Parts&, ClashRequest&)>& spoil) {
    Parts parts = {partOf(model, kHere, 0), partOf(model, at(0.5, 0, 0), 1)};
    ClashRequest request;
    spoil(parts, request);
    expectRefused([&] { findClashes(parts, request); }, words);
  };
  const double nan = std::nan(""), inf = HUGE_VAL;
  for (const double bad : {-1.0, nan, inf}) {
    refused("touch", [&](Parts&, ClashRequest& r) { r.touch = bad; });
    refused("clearance", [&](Parts&, ClashRequest& r) { r.clearance = bad; });
    refused("'part 1'", [&](Parts& p, ClashRequest&) { p[1].X_WP.translation()[0] = bad * inf; });
  }
  refused("more than the clearance", [](Parts&, ClashRequest& r) {
    r.touch = 0.2;
    r.clearance = 0.1;
  });
  refused("threads", [](Parts&, ClashRequest& r) { r.threads = -1; });
  refused("'part 1'", [](Parts& p, ClashRequest&) { p[1].X_WP.linear() *= 1.1; });
  refused("part 'part 1': a collision geometry is null",
          [](Parts& p, ClashRequest&) { p[1].geometry = nullptr; });
  refused("Sphere<double> is no part; fcl::generateBVHModel() makes a mesh",
          [](Parts& p, ClashRequest&) { p[1].geometry = std::make_shared<fcl::Sphered>(1); });
  refused("is no part; kios::toKIOS() makes a mesh", [](Parts& p, ClashRequest&) {
    p[1].geometry = scenes::buildModel<fcl::OBBRSSd>(scenes::icosphere(1, 1));
  });
  for (const double bad : {-1.0, nan, inf}) {
    refused("'part 1': the fcl::Box has side", [&](Parts& p, ClashRequest&) {
      p[0].geometry = std::make_shared<fcl::Boxd>(1, 2, 1);
      p[1].geometry = std::make_shared<fcl::Boxd>(1, bad, 1);
    });
  }
  refused("'part 1': the model bounds no solid", [](Parts& p, ClashRequest&) {
    p[1].geometry = std::make_shared<fcl::Convexd>(
        std::make_shared<std::vector<fcl::Vector3d>>(3, fcl::Vector3d(1, 2, 3)), 1,
        std::make_shared<std::vector<int>>(std::vector<int>{3, 0, 1, 2}));
  });
  refused("'part 1'", [](Parts& p, ClashRequest&) { p[1].geometry = std::make_shared<Modeld>(); });
  refused("'part 0': another part has this name",
          [](Parts& p, ClashRequest&) { p[1].name = "part 0"; });
  refused("'nut', to be ignored", [](Parts&, ClashRequest& r) { r.ignored = {{"part 0", "nut"}}; });
  refused("'part 0'", [](Parts&, ClashRequest& r) { r.ignored = {{"part 0", "part 0"}}; });
  refused("max_pairs", [](Parts&, ClashRequest& r) { r.max_pairs = 0; });
}

TEST(ClashRules, HoldAtEveryScale) {
  for (const double scale : {1e-60, 1e-9, 1e9, 1e60}) {
    SCOPED_TRACE(scale);
    const auto box = solidOf(transformed(scenes::subdividedBox({1, 1, 1}, 2), scale, {0, 0, 0}));
    ClashRequest request;
    request.touch = 1e-6 * scale;
    request.clearance = 0.1 * scale;
    const auto status = [&](double x) {
      return only({partOf(box, kHere, 0), partOf(box, at(x * scale, 0, 0), 1)}, request).status;
    };
    EXPECT_EQ(status(0), ClashStatus::kDuplicate);
    EXPECT_EQ(status(0.9), ClashStatus::kOverlap);
    EXPECT_EQ(status(1 - 1e-9), ClashStatus::kTouch);
    EXPECT_EQ(status(1), ClashStatus::kTouch);
    EXPECT_EQ(status(1 + 1e-9), ClashStatus::kTouch);
    EXPECT_EQ(status(1.05), ClashStatus::kClearance);
  }
}

}  // namespace
}  // namespace kios::testing
