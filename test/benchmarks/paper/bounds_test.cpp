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

PackedPolicy::Shared shareOf(const PackedPolicy& policy, const PointSet& model) {
  return policy.share(model.data(), static_cast<int>(model.size()));
}
template <typename Policy>
typename Policy::Volume fitOf(const Policy& policy, const PointSet& points,
                              const typename Policy::Shared& model) {
  return policy.fit(points.data(), static_cast<int>(points.size()), model);
}

/// Returns the first sphere of v that doesn't contain p, as stored; -1 if there is none.
int excluding(const CapSpheres& v, const PackedPolicy::Shared& model, const fcl::Vector3d& p) {
  for (int i = 0; i <= v.caps; ++i) {
    const float o[3] = {i ? v.x[i - 1] : 0, i ? v.y[i - 1] : 0, i ? v.z[i - 1] : 0};
    Exact sum = 0;
    for (int c = 0; c < 3; ++c) {
      const Exact center = ldexp(Exact(v.center[c]) + Exact(o[c]), model.exponent);
      const Exact d = Exact(p[c]) - Exact(model.origin[c]) - center;
      sum += d * d;
    }
    const Exact r = ldexp(Exact(i ? v.r[i - 1] : v.radius), model.exponent);
    if (sum > r * r) return i;
  }
  return -1;
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

TEST(Variants, StoredSpheresContainTheContent) {
  std::map<std::string, int> caps;
  int index = 0;
  forEachPackedPolicy([&](const std::string& name, const PackedPolicy& policy) {
    Random random(100 + index++);
    for (int set = 0; set < 700; ++set) {
      const Model m(random);
      const auto model = shareOf(policy, m.all);
      PackedStore store;
      const CapSpheres fitted = fitOf(policy, m.content, model);
      store.add(fitted);
      const CapSpheres v = policy.unpack(store[0], model);
      ASSERT_FALSE(v.empty);
      ASSERT_EQ(v.caps, fitted.caps);
      caps[name] = std::max(caps[name], v.caps);
      for (const auto& p : m.content) {
        ASSERT_EQ(excluding(v, model, p), -1) << name << ", set " << set;
        ASSERT_TRUE(policy.contains(store[0], model, p)) << name << ", set " << set;
      }
      for (int i = 0; v.shared_radius && i < v.caps; ++i) ASSERT_EQ(v.r[i], v.r[0]) << name;
    }
  });
  EXPECT_EQ(caps["oriented 1, " + nameOf({})], 0);
  EXPECT_EQ(caps["oriented 3, " + nameOf({})], 2);
  EXPECT_EQ(caps["oriented 7, " + nameOf({})], 6);
  FitOptions all;
  all.count = SphereCount::kAll;
  EXPECT_EQ(caps["given directions, " + nameOf(all)], 8);
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
      using Policy = std::decay_t<decltype(policy)>;
      const auto a = policy.share(model_a.data(), static_cast<int>(model_a.size()));
      const auto b = policy.share(model_b.data(), static_cast<int>(model_b.size()));
      typename Policy::Store store;
      store.add(fitOf(policy, pair.points_a, a));
      store.add(fitOf(policy, pair.points_b, b));
      const auto& placed = policy.place(a, b, X);
      const double bound = policy.separation(store[0], store[1], placed, kInfinity);
      ASSERT_TRUE(std::isfinite(bound)) << name << ", pair " << i;
      // With `enough` it may stop, but proves the same.
      const double early = policy.separation(store[0], store[1], placed, 0.5 * bound);
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
      typename std::decay_t<decltype(policy)>::Store store;
      const auto shared = policy.share(a.data(), 30);
      store.add(fitOf(policy, a, shared));
      const auto& placed = policy.place(shared, shared, X);
      const double bound = policy.separation(store[0], store[0], placed, kInfinity);
      EXPECT_GT(bound, 95 * scale) << name << ", scale " << scale << ", offset " << offset;
    });
  }
}

TEST(Variants, EmptyIsInfinitelyFarAndContainsNothing) {
  forEachPolicy([](const std::string& name, const auto& policy) {
    const PointSet points = {{0, 0, 0}, {1, 0, 0}, {0, 1, 0}};
    const auto model = policy.share(points.data(), 3);
    const auto none = policy.share(nullptr, 0);
    typename std::decay_t<decltype(policy)>::Store store;
    store.add(policy.fit(nullptr, 0, model));
    store.add(fitOf(policy, points, model));
    store.add(policy.fit(nullptr, 0, none));
    const RelativePose<double> X(fcl::Matrix3d::Identity(), fcl::Vector3d(0, 0, 0));
    EXPECT_EQ(policy.separation(store[0], store[1], policy.place(model, model, X), 0), kInfinity);
    EXPECT_EQ(policy.separation(store[1], store[2], policy.place(model, none, X), 0), kInfinity);
    EXPECT_LE(policy.separation(store[1], store[1], policy.place(model, model, X), 0), 0) << name;
    EXPECT_FALSE(policy.contains(store[0], model, points[0])) << name;
    EXPECT_TRUE(policy.contains(store[1], model, points[0])) << name;
    EXPECT_FALSE(policy.contains(store[1], model, fcl::Vector3d(9, 9, 9))) << name;
    EXPECT_FALSE(policy.contains(store[1], model, fcl::Vector3d(NAN, 0, 0))) << name;
  });
}

}  // namespace
}  // namespace kios::testing
