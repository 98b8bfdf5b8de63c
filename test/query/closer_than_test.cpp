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
  void check(const Mesh& a, const Mesh& b, const std::vector<Poses<S>>& poses) {
    const auto model_a = modelOf<S>(a), model_b = modelOf<S>(b);
    constexpr S kInf = std::numeric_limits<S>::infinity();
    constexpr S kEps = std::numeric_limits<S>::epsilon();
    const S size = static_cast<S>(std::max(scenes::extent(a), scenes::extent(b)));
    Random random(31);
    WarmStart warm;
    for (const auto& [X_WA, X_WB] : poses) {
      const S d = kios::distanceBracket(*model_a, X_WA, *model_b, X_WB).distance;
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
        DistanceBracketResult<S> proof;
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
    SCOPED_TRACE(m.name);
    const double size = scenes::extent(m.mesh);
    this->check(m.mesh, m.mesh, posesOf<S>(m.mesh, m.mesh, 6, 0.6 * size, 32));
  }
}

}  // namespace
}  // namespace kios::testing
