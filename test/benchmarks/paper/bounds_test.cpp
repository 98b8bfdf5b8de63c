// SPDX-FileCopyrightText: 2026 The fcl_kios authors
// SPDX-License-Identifier: BSD-3-Clause
//
// All fits and variants: every stored sphere contains its content, decided without rounding, and no
// bound exceeds the distance of the contents, at hard poses of hard sets.
#include <gtest/gtest.h>

#include <map>
#include <stdexcept>

#include "benchmarks/paper/policies.h"
#include "not_finite.h"
#include "volume/exact_pairs.h"

namespace kios::testing {
namespace {

using PointSet = Points<double>;

template <typename Policy>
typename Policy::Volume fitOf(const Policy& policy, const PointSet& points,
                              const typename Policy::Shared& model) {
  return policy.fit(points.data(), static_cast<int>(points.size()), model);
}

bool containsExactly(const Sphere& sphere, const fcl::Vector3d& p) {
  Exact sum = 0;
  for (int c = 0; c < 3; ++c) {
    const Exact d = Exact(p[c]) - Exact(sphere.center[c]);
    sum += d * d;
  }
  return sum <= Exact(sphere.radius) * Exact(sphere.radius);
}

/// Holds a set with a subset that is the content: models of one volume, of many, and much larger
/// ones.
struct Model {
  explicit Model(Random& random) {
    all = hardPointSet<double>(random, randomCount(random));
    const auto size = static_cast<int>(all.size());
    const int first = below(random, size), count = 1 + below(random, size - first);
    content.assign(all.begin() + first, all.begin() + first + count);
    if (random.unit() < 0.3) content = all;
  }
  PointSet all, content;
};

TEST(Variants, SpheresContainTheContent) {
  std::map<std::string, std::size_t> most;
  int index = 0;
  forEachKind([&](const std::string& name, const SpheresPolicy& policy) {
    Random random(100 + index++);
    const std::size_t place = name.rfind("oriented", 0) == 0 ? 3 : 1;
    const bool shared = name.find("shared") != std::string::npos;
    for (int set = 0; set < 700; ++set) {
      const Model m(random);
      const auto model = policy.share(m.all.data(), static_cast<int>(m.all.size()));
      const Spheres v = fitOf(policy, m.content, model);
      ASSERT_FALSE(v.all.empty());
      most[name] = std::max(most[name], v.all.size());
      for (const auto& p : m.content) {
        for (const Sphere& sphere : v.all) ASSERT_TRUE(containsExactly(sphere, p)) << name << set;
      }
      const std::size_t caps = v.all.size() - 1;
      for (std::size_t i = 1; shared && i <= caps; ++i) {
        ASSERT_EQ(v.all[i].radius, v.all[1].radius) << name;
      }
      ASSERT_EQ(static_cast<std::size_t>(v.floats),
                4 + caps * place + (shared && caps > 0 ? 1 : caps))
          << name;
    }
  });
  EXPECT_EQ(most["oriented 1, " + nameOf({})], 1U);
  EXPECT_EQ(most["oriented 3, " + nameOf({})], 3U);
  EXPECT_EQ(most["oriented 7, " + nameOf({})], 7U);
  FitOptions all;
  all.count = SphereCount::kAll;
  EXPECT_EQ(most["given directions, " + nameOf(all)], 9U);
}

TEST(Variants, BoundsNeverExceedTheDistance) {
  Random random(4);
  int apart = 0, tested = 0;
  for (int i = 0; i < 2'500; ++i) {
    const HardPair<double> pair(random);
    const RelativePose<double> X(pair.R, pair.T);
    // Every third model reaches beyond its volume, up to 1e6 sizes.
    PointSet model_a = pair.points_a, model_b = pair.points_b;
    if (i % 3 == 0) {
      const double size = std::pow(10, random.uniform(-1, 6)) * double{pair.a.radius0};
      model_a.push_back(model_a[0] + size * randomDirection(random));
      model_b.insert(model_b.begin(), model_b[0] + size * randomDirection(random));
    }
    // The true distance is decided once, for the largest of the bounds.
    double largest = -kInfinity;
    std::string which;
    forEachPolicy([&](const std::string& name, const auto& policy) {
      const auto a = policy.share(model_a.data(), static_cast<int>(model_a.size()));
      const auto b = policy.share(model_b.data(), static_cast<int>(model_b.size()));
      const auto of_a = fitOf(policy, pair.points_a, a), of_b = fitOf(policy, pair.points_b, b);
      const auto& placed = policy.place(a, b, X);
      const double bound = policy.separation(of_a, of_b, placed, kInfinity);
      ASSERT_TRUE(std::isfinite(bound)) << name << ", pair " << i;
      // With `enough` it may stop, but proves the same.
      const double early = policy.separation(of_a, of_b, placed, 0.5 * bound);
      ASSERT_LE(early, bound) << name;
      ASSERT_EQ(early > 0.5 * bound, bound > 0.5 * bound) << name;
      ++tested;
      apart += bound > 0;
      if (bound <= largest) return;
      largest = bound;
      which = name;
    });
    ASSERT_TRUE(pair.distanceIsAtLeast(largest)) << which << ", pair " << i << ": " << largest;
    ASSERT_TRUE(pair.roundedDistanceIsAtLeast(largest)) << which << ", pair " << i;
  }
  EXPECT_GT(apart, tested / 5);
}

// Bounds are tight: no conservative pad eats them up at any place or scale.
TEST(Variants, BoundsOfSeparatedSetsAreTight) {
  Random random(5);
  for (int i = 0; i < 300; ++i) {
    const double scale = std::pow(10, random.uniform(-140, 140));
    const double offset = i % 2 ? 0 : std::pow(10, random.uniform(0, 6));
    const PointSet a =
        place<double>(random, shapePoints(random, PointShape::kRandom, 30), offset, scale);
    PointSet b = a;
    const RelativePose<double> X(fcl::Matrix3d::Identity(),
                                 fcl::Vector3d(100 * scale * randomDirection(random)));
    forEachPolicy([&](const std::string& name, const auto& policy) {
      const auto shared = policy.share(a.data(), 30);
      const auto volume = fitOf(policy, a, shared);
      const auto& placed = policy.place(shared, shared, X);
      const double bound = policy.separation(volume, volume, placed, kInfinity);
      EXPECT_GT(bound, 95 * scale) << name << ", scale " << scale << ", offset " << offset;
    });
  }
}

}  // namespace
}  // namespace kios::testing
