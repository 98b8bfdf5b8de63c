// SPDX-FileCopyrightText: 2026 The fcl_kios authors
// SPDX-License-Identifier: BSD-3-Clause
//
// The sum of two volumes encloses the contents of both, whatever the order and the depth.
#include <gtest/gtest.h>

#include <algorithm>

#include "fcl_kios/paper.h"
#include "paper/all_fits.h"
#include "scalars.h"
#include "volume/exact_spheres.h"

namespace kios::testing {
namespace {

KIOS_SCALAR_SUITE(Merge);

/// Merges leaves of 1 to 3 points pairwise up to the root and checks every node on the way.
template <typename S>
std::string bottomUpViolation(const Points<S>& points, Random& random) {
  struct Node {
    kIOS<S> volume;
    Points<S> content;
  };
  std::vector<Node> level;
  for (std::size_t i = 0; i < points.size();) {
    const std::size_t end = std::min(points.size(), i + 1 + below(random, 3));
    const Points<S> leaf(points.begin() + i, points.begin() + end);
    level.push_back({fitted(leaf), leaf});
    i = end;
  }
  while (level.size() > 1) {
    std::vector<Node> above;
    for (std::size_t i = 0; i < level.size(); i += 2) {
      Node node = level[i];
      if (i + 1 < level.size()) {
        const Node& right = level[i + 1];
        node.volume = node.volume + right.volume;
        node.content.insert(node.content.end(), right.content.begin(), right.content.end());
      }
      std::string wrong = violation(node.volume, node.content);
      if (wrong.empty()) wrong = measureViolation(node.volume, node.content);
      if (!wrong.empty()) return wrong + ", n = " + std::to_string(node.content.size());
      above.push_back(std::move(node));
    }
    level = std::move(above);
  }
  return {};
}

TYPED_TEST(Merge, BottomUpTreesContainTheirPoints) {
  Random random(1);
  for (int tree = 0; tree < 400; ++tree) {
    auto points = hardPointSet<TypeParam>(random, 1 + below(random, tree % 20 ? 200 : 2000));
    if (tree % 2) {
      std::sort(points.begin(), points.end(),
                [](const auto& p, const auto& q) { return p[0] < q[0]; });
    }
    ASSERT_EQ(bottomUpViolation(points, random), "") << "tree " << tree;
  }
}

TYPED_TEST(Merge, ContainsBothAndCommutesBitwise) {
  using S = TypeParam;
  const std::vector<FitOptions> fits = allFits();
  Random random(2);
  for (int pair = 0; pair < 40'000; ++pair) {
    auto points = hardPointSet<S>(random, randomCount(random));
    const auto a = fitted(points);
    auto others = hardPointSet<S>(random, randomCount(random));
    if (pair % 4 == 0) others = points;
    if (pair % 4 == 1) others.resize(1, points[0]);
    if (pair % 4 == 2) {  // near each other and of one scale
      others = points;
      for (auto& p : others) p = (p - points[0]) * static_cast<S>(random.unit()) + points[0];
    }
    const kIOS<S> b =
        fitted(others, pair % 3 ? FitOptions(FitMethod::kTuned) : fits[pair / 3 % fits.size()]);
    const kIOS<S> sum = a + b;
    ASSERT_TRUE(bitwiseEqual(sum, b + a)) << "pair " << pair;
    kIOS<S> assigned = a;
    assigned += b;
    ASSERT_TRUE(bitwiseEqual(sum, assigned)) << "pair " << pair;
    points.insert(points.end(), others.begin(), others.end());
    ASSERT_EQ(violation(sum, points), "") << "pair " << pair;
    ASSERT_EQ(measureViolation(sum, points), "") << "pair " << pair;
  }
}

TYPED_TEST(Merge, CommutesBitwiseForZerosOfEitherSign) {
  using S = TypeParam;
  for (const S radius : {S(0), S(1)}) {
    kIOS<S> plus = fitted<S>({{1 - radius, 0, 0}, {1 + radius, 0, 0}}), minus = plus;
    minus.center0[1] = -S(0);
    minus.center0[2] = -S(0);
    EXPECT_TRUE(bitwiseEqual(plus + minus, minus + plus)) << radius;
  }
}

TYPED_TEST(Merge, EmptyIsNeutral) {
  using S = TypeParam;
  Random random(3);
  const kIOS<S> empty;
  EXPECT_EQ((empty + empty).k(), 0);
  for (int set = 0; set < 100; ++set) {
    const auto v = fitted(hardPointSet<S>(random, randomCount(random)));
    EXPECT_TRUE(bitwiseEqual(v + empty, v));
    EXPECT_TRUE(bitwiseEqual(empty + v, v));
    kIOS<S> from_empty;
    from_empty += v;
    EXPECT_TRUE(bitwiseEqual(from_empty, v));
  }
}

TYPED_TEST(Merge, PointsGrowAVolumeFromEmpty) {
  using S = TypeParam;
  Random random(4);
  for (int set = 0; set < 3'000; ++set) {
    const auto points = hardPointSet<S>(random, 1 + below(random, 30));
    kIOS<S> v;
    Points<S> content;
    for (const auto& p : points) {
      v += p;
      content.push_back(p);
      ASSERT_EQ(violation(v, content), "") << "set " << set << " n = " << content.size();
      ASSERT_TRUE(v.contain(p));
    }
    ASSERT_EQ(measureViolation(v, content), "") << "set " << set;
  }
}

TYPED_TEST(Merge, ContainsNoPointThatIsNotFinite) {
  using S = TypeParam;
  constexpr S kNan = std::numeric_limits<S>::quiet_NaN();
  const auto v = fitted<S>({{-1, 0, 0}, {1, 0, 0}});
  EXPECT_FALSE(v.contain(fcl::Vector3<S>(kNan, 0, 0)));
  EXPECT_FALSE(v.contain(fcl::Vector3<S>(std::numeric_limits<S>::infinity(), 0, 0)));
}

TYPED_TEST(Merge, HalvesOfASetGrowByHalfAtMost) {
  using S = TypeParam;
  Random random(5);
  for (int set = 0; set < 2'000; ++set) {
    const auto shape = set % 2 ? PointShape::kRandom : PointShape::kCoplanar;
    auto points = place<S>(random, shapePoints(random, shape, 8 + below(random, 50)), 0, 1);
    std::sort(points.begin(), points.end(),
              [](const auto& p, const auto& q) { return p[0] < q[0]; });
    const auto middle = points.begin() + points.size() / 2;
    const auto merged =
        fitted(Points<S>(points.begin(), middle)) + fitted(Points<S>(middle, points.end()));
    ASSERT_LE(merged.radius0, 1.5 * fitted(points).radius0) << "set " << set;
  }
}

TYPED_TEST(Merge, NestedAndEqualOperandsDoNotGrow) {
  using S = TypeParam;
  Random random(6);
  const double growth = 1 + 10 * std::numeric_limits<S>::epsilon();
  int nested = 0;
  for (int set = 0; set < 2'000; ++set) {
    auto points = hardPointSet<S>(random, 4 + below(random, 30));
    const auto outer = fitted(points);
    const double bound = growth * outer.radius0 + 8 * std::numeric_limits<S>::min();
    EXPECT_LE((outer + outer).radius0, bound) << "set " << set;
    for (auto& p : points) p = outer.center0 + (p - outer.center0) * S(0.3);
    const auto inner = fitted(points);
    // Far from the origin, points that are rounded to S may lie outside.
    const fcl::Vector3d between =
        inner.center0.template cast<double>() - outer.center0.template cast<double>();
    if (between.stableNorm() + inner.radius0 > outer.radius0) continue;
    ++nested;
    EXPECT_LE((outer + inner).radius0, bound) << "set " << set;
  }
  EXPECT_GE(nested, 1'000);
}

// Merged caps still cut S0 off: a flat patch stays flat over four levels of merges, at any scale.
TYPED_TEST(Merge, FlatPatchStaysFlat) {
  using S = TypeParam;
  const bool is_double = sizeof(S) == sizeof(double);
  for (const double scale : {1.0, is_double ? 1e150 : 1e18, is_double ? 1e-150 : 1e-18}) {
    std::vector<kIOS<S>> level;
    for (int i = 0; i < 16; ++i) {
      Points<S> tile;
      for (int corner = 0; corner < 4; ++corner) {
        const fcl::Vector3d p(i + corner % 2, 8 * (corner / 2), 0.05 * (i + corner) / 16);
        tile.push_back((p * scale).cast<S>());
      }
      level.push_back(fitted(tile));
    }
    for (; level.size() > 1; level.resize(level.size() / 2)) {
      for (std::size_t i = 0; i < level.size() / 2; ++i) level[i] = level[2 * i] + level[2 * i + 1];
    }
    EXPECT_EQ(level[0].k(), 5) << scale;
    EXPECT_LE(level[0].depth(), 0.75 * level[0].width()) << scale;
  }
}

}  // namespace
}  // namespace kios::testing
