// SPDX-FileCopyrightText: 2026 The fcl_kios authors
// SPDX-License-Identifier: BSD-3-Clause
//
// Meshes far from their own origins: the cost of the common frame's rounding (docs/guarantees.md),
// measured in long double.

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <cstdio>

#include "query/query_cases.h"
#include "scalars.h"
#include "scenes/random.h"

namespace kios::testing {
namespace {

using Long3 = Eigen::Matrix<long double, 3, 1>;
using LongMatrix3 = Eigen::Matrix<long double, 3, 3>;

template <typename S>
fcl::Vector3<S> randomPoint(Random& random, double size) {
  return (size * inCube(random)).cast<S>();
}

/// Returns the point as a mesh: a degenerate triangle, three times.
template <typename S>
std::shared_ptr<Model<S>> pointModel(const fcl::Vector3<S>& p) {
  return makeModel<S>({p, p, p}, {{0, 1, 2}, {0, 1, 2}, {0, 1, 2}});
}

KIOS_SCALAR_SUITE(OwnOrigin);

// Two points near each other in the world, each `offset` from its model's origin, poses at random.
TYPED_TEST(OwnOrigin, ErrorIsThatOfTheCommonFrame) {
  using S = TypeParam;
  constexpr bool kRounds = sizeof(S) == sizeof(float);
  constexpr double kEps = std::numeric_limits<double>::epsilon();
  scenes::Random random(11);
  std::uint64_t seed = 0;
  double worst = 0;
  for (const double offset : {0.0, 1.0, 1e4, 1e6, 1e8}) {
    double worst_here = 0;
    for (int k = 0; k < 2000; ++k) {
      const fcl::Vector3<S> p = randomPoint<S>(random, offset) + randomPoint<S>(random, 1);
      const fcl::Vector3<S> x = randomPoint<S>(random, offset) + randomPoint<S>(random, 1);
      const auto poses = scenes::randomPoses(2, 1, ++seed);
      fcl::Transform3<S> X_W1 = poses[0].cast<S>(), X_W2 = poses[1].cast<S>();
      X_W1.translation() -= X_W1.linear() * p;
      X_W2.translation() -= X_W2.linear() * x;

      // The stored vertices and poses in exact arithmetic, so far as it matters here.
      const LongMatrix3 R1 = X_W1.linear().template cast<long double>(),
                        R2 = X_W2.linear().template cast<long double>();
      const Long3 t = X_W2.translation().template cast<long double>() -
                      X_W1.translation().template cast<long double>();
      const Long3 p_1 = p.template cast<long double>(), x_2 = x.template cast<long double>();
      const long double exact = (R1.transpose() * (R2 * x_2 + t) - p_1).norm();
      const long double in_world = (R2 * x_2 + t - R1 * p_1).norm();

      const auto a = pointModel<S>(p), b = pointModel<S>(x);
      const DistanceBracketResult<S> answer = kios::distanceBracket(*a, X_W1, *b, X_W2);
      const double size = static_cast<double>(x_2.template lpNorm<1>() + t.norm());
      const auto error = static_cast<double>(std::abs((long double)(answer.distance) - exact));
      const double of_triangles =
          (16 * kEps + (kRounds ? 0x1p-24 : 0)) * static_cast<double>(exact);
      ASSERT_LE(error, of_triangles + std::sqrt(3.0) * 4 * kEps * size) << offset;
      ASSERT_LE((long double)(answer.lower_bound), exact) << offset;
      ASSERT_GE((long double)(answer.upper_bound), exact) << offset;
      // The world's distance is another as far as R1 isn't orthonormal.
      const auto E = static_cast<double>((R1.transpose() * R1 - LongMatrix3::Identity()).norm());
      const auto skew = static_cast<double>(std::abs(in_world - exact));
      ASSERT_LE(skew, 1.01 * E * static_cast<double>(p_1.norm() + exact)) << offset;

      fcl::DistanceResult<S> result;
      ASSERT_EQ(fcl::distance(a.get(), X_W1, b.get(), X_W2, fcl::DistanceRequest<S>(), result),
                answer.distance);
      worst_here = std::max(worst_here, error / (kEps * size));
    }
    std::printf("offset %g: %.3f eps (|x|_1 + |t2 - t1|)\n", offset, worst_here);
    if (offset < 1e4 || kRounds) continue;  // where the triangles' own error or the answer's shows
    EXPECT_GT(worst_here, 0.1) << offset;   // else nothing was measured
    worst = std::max(worst, worst_here);
  }
  EXPECT_LT(worst, 0.75) << "the figure of docs/guarantees.md";
}

// R^T R is off from I by some roundings: as a rotation between them, it would move equal bodies
// apart. Rotations that are off by more are taken as given.
TYPED_TEST(OwnOrigin, EqualRotationsLeaveNone) {
  using S = TypeParam;
  scenes::Random random(17);
  std::uint64_t seed = 100;
  constexpr double kUlp = 0.5 * double{std::numeric_limits<S>::epsilon()};
  int rounded = 0;
  for (const double offset : {0.0, 1.0, 1e4}) {
    for (int k = 0; k < 100; ++k) {
      fcl::Transform3<S> X = scenes::randomPoses(1, 1, ++seed)[0].template cast<S>();
      if (k % 5 == 0) X.linear() *= S(1) + S(k % 2 == 0 ? 1e-5 : 100 * kUlp);
      const LongMatrix3 R = X.linear().template cast<long double>();
      const LongMatrix3 E = R.transpose() * R - LongMatrix3::Identity();
      const auto longest = static_cast<double>(E.rowwise().norm().maxCoeff());
      const fcl::Vector3<S> p = randomPoint<S>(random, offset), x = randomPoint<S>(random, 1);
      const auto body = scenes::moved(
          fcl::Transform3d(Eigen::Translation3d(p.template cast<double>())),
          k % 2 == 0 ? scenes::icosphere(0.5, 1) : scenes::subdividedBox({1, 2, 3}, 1 + k % 3));
      const auto a = scenes::buildModel<kIOS<S>>(body), b = scenes::buildModel<kIOS<S>>(body);
      rounded += longest <= 7 * kUlp;
      for (const bool prepared : {false, true}) {
        if (prepared) prepare(*a), prepare(*b);
        if (longest > 7 * kUlp) continue;
        EXPECT_EQ(kios::distanceBracket(*a, X, *b, X).distance, 0) << offset << ", " << k;
        fcl::CollisionResult<S> result;
        EXPECT_EQ(fcl::collide(a.get(), X, b.get(), X, fcl::CollisionRequest<S>(), result), 1U)
            << offset << ", " << k;
      }
      // Whatever R^T R, points are apart as in the frame that docs/guarantees.md defines.
      fcl::Transform3<S> Y = X;
      Y.translation() += x;
      const auto at = pointModel<S>(p), too = pointModel<S>(p);
      const Long3 t = Y.translation().template cast<long double>() -
                      X.translation().template cast<long double>();
      const Long3 p_1 = p.template cast<long double>();
      const auto exact = static_cast<double>((R.transpose() * (R * p_1 + t) - p_1).norm());
      const double size = p.template lpNorm<1>() + static_cast<double>(t.norm());
      EXPECT_NEAR(double{kios::distanceBracket(*at, X, *too, Y).distance}, exact,
                  32 * kUlp * exact + std::sqrt(3.0) * 8 * kUlp * size)
          << longest / kUlp;
    }
  }
  EXPECT_GT(rounded, 150);
  EXPECT_LT(rounded, 250);
}

}  // namespace
}  // namespace kios::testing
