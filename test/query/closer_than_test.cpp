// SPDX-FileCopyrightText: 2026 The fcl_kios authors
// SPDX-License-Identifier: BSD-3-Clause
//
// kios::closerThan is true if and only if the exact distance is <= t, bit for bit.

#include <gtest/gtest.h>

#include "query/query_cases.h"

namespace kios::testing {
namespace {

template <typename S>
class CloserThan : public ::testing::Test {
 protected:
  void check(const Mesh& a, const Mesh& b, bool engine, const std::vector<Poses<S>>& poses) {
    const auto model_a = modelOf<S>(a, engine), model_b = modelOf<S>(b, engine);
    constexpr S kInf = std::numeric_limits<S>::infinity();
    constexpr S kEps = std::numeric_limits<S>::epsilon();
    const S size = static_cast<S>(std::max(scenes::extent(a), scenes::extent(b)));
    Random random(31);
    WarmStart warm;
    for (const auto& [X_WA, X_WB] : poses) {
      const S d = kios::distance(*model_a, X_WA, *model_b, X_WB).distance;
      std::vector<S> ts = {0,
                           d,
                           std::nextafter(d, kInf),
                           std::nextafter(d, -kInf),
                           S(0.9) * d,
                           S(1.1) * d,
                           std::numeric_limits<S>::denorm_min(),
                           -1,
                           kInf,
                           -kInf,
                           std::numeric_limits<S>::max()};
      for (int i = -3; i <= 3; ++i) {
        for (const S step : {kEps, 100 * kEps, 10000 * kEps}) {
          ts.push_back(d + static_cast<S>(i) * step * size);
        }
      }
      ts.push_back(static_cast<S>(random.uniform(0, 2 * double{d})));
      for (const S t : ts) {
        DistanceAnswer<S> proof;
        WarmStart* const start = random.uniform(0, 1) < 0.5 ? &warm : nullptr;
        ASSERT_EQ(closerThan(*model_a, X_WA, *model_b, X_WB, t, &proof, start), d <= t)
            << d << " " << t;
        ASSERT_EQ(closerThan(*model_a, X_WA, *model_b, X_WB, t), d <= t) << d << " " << t;
        if (d <= t) {
          ASSERT_LE(proof.distance, t);
          ASSERT_GE(proof.triangle_a, 0);
        } else {
          ASSERT_TRUE(proof.lower_bound > t || proof.distance == d) << d << " " << t;
        }
        ASSERT_LE(proof.lower_bound, d);
      }
    }
  }
};
using Scalars = ::testing::Types<double, float>;
TYPED_TEST_SUITE(CloserThan, Scalars);

TYPED_TEST(CloserThan, AgreesWithTheExactDistance) {
  using S = TypeParam;
  for (const NamedMesh& m : allMeshes<S>()) {
    for (const bool engine : {true, false}) {
      SCOPED_TRACE(m.name + (engine ? "" : ", FCL's tree"));
      const double size = scenes::extent(m.mesh);
      this->check(m.mesh, m.mesh, engine, posesOf<S>(m.mesh, m.mesh, 4, 0.6 * size, 32));
    }
  }
}

TYPED_TEST(CloserThan, Motions) {
  using S = TypeParam;
  std::vector<Poses<S>> poses;
  for (const Frame& f : scenes::fallingMotion(100)) {
    poses.push_back({f.X_WA.template cast<S>(), f.X_WB.template cast<S>()});
  }
  this->check(scenes::bentTorus(), scenes::knobbyTorus(), true, poses);
}

// Boxes whose faces touch, or are an ulp apart or inside each other.
TYPED_TEST(CloserThan, Touching) {
  using S = TypeParam;
  const Mesh box = scenes::subdividedBox({1, 1, 1}, 3);
  std::vector<Poses<S>> poses;
  for (const S x : {S(1), std::nextafter(S(1), S(2)), std::nextafter(S(1), S(0)), S(1.125)}) {
    fcl::Transform3<S> X = fcl::Transform3<S>::Identity();
    X.translation() = fcl::Vector3<S>(x, S(0.25), 0);
    poses.push_back({fcl::Transform3<S>::Identity(), X});
  }
  const Mesh coarse = scenes::subdividedBox({1, 1, 1}, 1),
             floor = scenes::subdividedBox({90, 90, 1}, 4);
  for (const bool engine : {true, false}) {
    this->check(box, box, engine, poses);
    this->check(coarse, coarse, engine, poses);
    for (auto& [X_WA, X_WB] : poses) X_WB.translation().z() = X_WB.translation().x();
    this->check(floor, box, engine, poses);
  }
}

}  // namespace
}  // namespace kios::testing
