// SPDX-FileCopyrightText: 2026 The fcl_kios authors
// SPDX-License-Identifier: BSD-3-Clause
//
// findClashes() against arithmetic for boxes; mesh_fuzz compares it with queries of every pair of
// other meshes.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <functional>
#include <limits>
#include <map>
#include <string>
#include <vector>

#include <fcl/geometry/shape/box.h>
#include <fcl/geometry/shape/convex.h>
#include "scene/clash_parts.h"

namespace kios::testing {
namespace {

/// An axis-aligned box whose corners are multiples of 1/8, so that what adds up is exact.
struct Box {
  fcl::Vector3d low, high;

  /// As a mesh, one in float, or a shape: of one kind for all i that are 6 or 11 modulo 12.
  ClashPart part(const fcl::Transform3d& X, std::size_t i) const {
    Mesh mesh = scenes::subdividedBox({1, 1, 1}, 1);
    for (fcl::Vector3d& p : mesh.vertices) {
      for (int c = 0; c < 3; ++c) p[c] = p[c] < 0 ? low[c] : high[c];
    }
    const std::size_t kind = i % 12;
    ClashPart part = partOf(kind < 2 ? toDouble(*solidOf<float>(mesh)) : solidOf(mesh), X, i);
    if (kind == 2 || kind == 3) {
      const std::vector<int> faces = {4, 0, 2, 3, 1, 4, 4, 5, 7, 6, 4, 0, 1, 5, 4,
                                      4, 2, 6, 7, 3, 4, 0, 4, 6, 2, 4, 1, 3, 7, 5};
      auto corners = std::make_shared<std::vector<fcl::Vector3d>>();
      for (int k = 0; k < 8; ++k) {
        corners->emplace_back((k & 1 ? high : low)[0], (k & 2 ? high : low)[1],
                              (k & 4 ? high : low)[2]);
      }
      part.geometry =
          std::make_shared<fcl::Convexd>(corners, 6, std::make_shared<std::vector<int>>(faces));
    } else if ((kind == 6 || kind > 8) && X.linear().isIdentity(0)) {  // else T rounds
      part.geometry = std::make_shared<fcl::Boxd>(high - low);
      part.X_WP = X * Eigen::Translation3d((low + high) / 2);
    }
    return part;
  }
};

Box randomBox(Random& random) {
  Box box;
  const auto eighths = [&](double least, double most) {
    return std::floor(random.uniform(least, most)) / 8;
  };
  for (int c = 0; c < 3; ++c) {
    box.low[c] = eighths(0, 32);
    box.high[c] = box.low[c] + eighths(1, 16);
  }
  return box;
}

struct Expected {
  ClashStatus status;
  double distance = 0;  // if they are apart
};

/// By arithmetic alone; none if the boxes are farther apart than the clearance.
std::optional<Expected> expectedOf(const Box& a, const Box& b, const ClashRequest& request) {
  if (a.low == b.low && a.high == b.high) return Expected{ClashStatus::kDuplicate};
  const fcl::Vector3d gap = (a.low - b.high).cwiseMax(b.low - a.high);
  if (gap.maxCoeff() < 0) {
    const auto in = [](const Box& x, const Box& y) {
      return (x.low - y.low).minCoeff() > 0 && (y.high - x.high).minCoeff() > 0;
    };
    return Expected{in(a, b) || in(b, a) ? ClashStatus::kInside : ClashStatus::kOverlap};
  }
  const double distance = gap.cwiseMax(0).norm();
  if (distance <= request.touch) return Expected{ClashStatus::kTouch, distance};
  if (distance <= request.clearance) return Expected{ClashStatus::kClearance, distance};
  return std::nullopt;
}

void expectEqual(const std::vector<ClashResult>& x, const std::vector<ClashResult>& y) {
  ASSERT_EQ(x.size(), y.size());
  for (std::size_t i = 0; i < x.size(); ++i) {
    EXPECT_EQ(Pair(x[i].a, x[i].b), Pair(y[i].a, y[i].b));
    EXPECT_EQ(x[i].status, y[i].status);
    EXPECT_EQ(x[i].deep, y[i].deep);
    EXPECT_EQ(x[i].decided, y[i].decided);
    EXPECT_EQ(x[i].lower, y[i].lower);
    EXPECT_EQ(x[i].upper, y[i].upper);
    for (int c = 0; c < 3; ++c) {
      EXPECT_EQ(x[i].point_a[c], y[i].point_a[c]);
      EXPECT_EQ(x[i].point_b[c], y[i].point_b[c]);
      EXPECT_EQ(x[i].way_out[c], y[i].way_out[c]);
    }
  }
}

TEST(Clashes, OfBoxesAreThoseOfArithmeticAtEveryPlace) {
  Random random(1);
  std::map<ClashStatus, int> seen;
  for (int round = 0; round < casesOr(4); ++round) {
    // Turned and moved all alike, the boxes clash as before; flush faces only to rounding.
    fcl::Transform3d X = fcl::Transform3d::Identity();
    if (round % 2 == 1) X = scenes::randomPoses(1, 1, 7 + static_cast<std::uint64_t>(round))[0];
    if (round % 4 == 3) X.translation() += fcl::Vector3d(1e6, -2e6, 1e3);
    ClashRequest request;
    request.clearance = 0.3;
    std::vector<Box> boxes;
    Parts parts;
    for (std::size_t i = 0; i < 120; ++i) {
      boxes.push_back(i % 12 == 11 ? boxes[i - 5] : randomBox(random));
      parts.push_back(boxes.back().part(X, i));
    }
    const auto clashes = findClashes(parts, request);
    auto found = byPair(clashes);
    for (std::size_t a = 0; a < boxes.size(); ++a) {
      for (std::size_t b = a + 1; b < boxes.size(); ++b) {
        SCOPED_TRACE(std::to_string(a) + " and " + std::to_string(b));
        const auto expected = expectedOf(boxes[a], boxes[b], request);
        const auto at = found.find({a, b});
        ASSERT_EQ(at != found.end(), expected.has_value());
        if (!expected) continue;
        const ClashResult clash = at->second;
        EXPECT_EQ(clash.status, expected->status);
        EXPECT_TRUE(clash.decided);
        ++seen[clash.status];
        const fcl::Vector3d overlap =
            boxes[a].high.cwiseMin(boxes[b].high) - boxes[a].low.cwiseMax(boxes[b].low);
        if (expected->status == ClashStatus::kClearance) {
          EXPECT_FALSE(clash.deep);
          EXPECT_LE(clash.lower, expected->distance);
          EXPECT_GE(clash.upper, expected->distance);
          EXPECT_NEAR((toVector(clash.point_a) - toVector(clash.point_b)).norm(), clash.lower,
                      1e-8);
        } else if (expected->status == ClashStatus::kOverlap ||
                   expected->status == ClashStatus::kInside) {
          EXPECT_TRUE(clash.deep);
          // A ball fits into what they share, which is no wider than twice the depth.
          EXPECT_GE(clash.upper, overlap.minCoeff() / 2);
          EXPECT_GT(clash.lower, request.touch);
          const fcl::Vector3d moved = toVector(clash.way_out);
          EXPECT_GE(moved.norm(), overlap.minCoeff() * (1 - 1e-9));
        }
      }
    }
    request.threads = 3;
    expectEqual(findClashes(parts, request), clashes);
  }
  EXPECT_EQ(seen.size(), 5u);  // every status
}

}  // namespace
}  // namespace kios::testing
