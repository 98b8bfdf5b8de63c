// SPDX-FileCopyrightText: 2026 The fcl_kios authors
// SPDX-License-Identifier: BSD-3-Clause
//
// The points that attain a distance bound, empty volumes, and the poses that are refused.
#include <gtest/gtest.h>

#include <stdexcept>

#include "fcl_kios/volume.h"
#include "scalars.h"
#include "volume/exact_pairs.h"

namespace kios::testing {
namespace {

KIOS_SCALAR_SUITE(Witness);

/// Returns the distance of p to the nearest surface of a sphere of v, where v sits at (R, T).
template <typename S>
long double offSurface(const kIOS<S>& v, const fcl::Matrix3<S>& R, const fcl::Vector3<S>& T,
                       const fcl::Vector3<S>& p) {
  long double least = std::numeric_limits<long double>::infinity();
  for (int i = 0; i < v.k(); ++i) {
    const StoredSphere<long double> sphere(v, i);
    fcl::Vector3<long double> center;
    for (int c = 0; c < 3; ++c) center[c] = sphere.center0[c] + sphere.offset[c];
    center = R.template cast<long double>() * center + T.template cast<long double>();
    const long double distance = (p.template cast<long double>() - center).norm();
    least = std::min(least, std::abs(distance - sphere.radius));
  }
  return least;
}

TYPED_TEST(Witness, LiesOnTheSpheresThatAttainTheBound) {
  using S = TypeParam;
  Random random(1);
  int apart = 0, close = 0;
  for (int i = 0; i < 40'000; ++i) {
    const HardPair<S> pair(random);
    fcl::Vector3<S> P, Q;
    const S value = distance(pair.R, pair.T, pair.a, pair.b, &P, &Q);
    ASSERT_TRUE(P.allFinite() && Q.allFinite()) << "pair " << i;
    // With and without points the bound comes from different code: both are tight.
    const long double pads = 1e-5L * pair.reaches() + 40 * pair.rounding() * pair.magnitude() +
                             1.5L * pair.shear() * pair.reaches() + 0x1p-499L +
                             64 * static_cast<long double>(std::numeric_limits<S>::min());
    ASSERT_NEAR(value, distance(pair.R, pair.T, pair.a, pair.b), static_cast<double>(pads)) << i;
    fcl::Vector3<S> only;
    ASSERT_EQ(distance(pair.R, pair.T, pair.a, pair.b, &only), value) << "pair " << i;
    ASSERT_EQ(only, P) << "pair " << i;
    ASSERT_EQ(distance<S>(pair.R, pair.T, pair.a, pair.b, nullptr, &only), value);
    ASSERT_EQ(only, Q) << "pair " << i;
    ASSERT_TRUE(pair.distanceIsAtLeast(value)) << "pair " << i;
    // Rounding, pads, and what a sheared pose does to a sphere.
    const long double tolerance = 64 * pair.rounding() * pair.magnitude() +
                                  1.5L * pair.shear() * pair.reaches() +
                                  64 * static_cast<long double>(std::numeric_limits<S>::min());
    if (value == 0) {
      ASSERT_EQ(P, Q) << "pair " << i;
      continue;
    }
    ++apart;
    const long double gap =
        (P.template cast<long double>() - Q.template cast<long double>()).norm();
    ASSERT_NEAR(static_cast<double>(gap), value, static_cast<double>(tolerance)) << "pair " << i;
    ASSERT_LE(offSurface<S>(pair.a, fcl::Matrix3<S>::Identity(), fcl::Vector3<S>::Zero(), P),
              tolerance)
        << "pair " << i;
    ASSERT_LE(offSurface<S>(pair.b, pair.R, pair.T, Q), tolerance) << "pair " << i;
    close += value > 1e3 * tolerance;
  }
  EXPECT_GT(apart, 10'000);
  EXPECT_GT(close, 5'000);
}

// Gaps and depths about as large as the pads of the bound: where value and points may disagree.
TYPED_TEST(Witness, IsOnePointWhereTheBoundIsZero) {
  using S = TypeParam;
  const S eps = std::numeric_limits<S>::epsilon();
  for (int i = -40; i < 80; ++i) {
    const auto a = fitted<S>({{1 + i * eps / 2, 0, 0}}), b = fitted<S>({{1, 0, 0}});
    fcl::Vector3<S> P, Q;
    if (a.distance(b, &P, &Q) == 0) {
      EXPECT_EQ(P, Q) << i;
    }
  }
}

TYPED_TEST(Witness, EmptyIsInfinitelyFarAndLeavesThePoints) {
  using S = TypeParam;
  kIOS<S> empty, point;
  point += fcl::Vector3<S>(1, 2, 3);
  const fcl::Matrix3<S> R = fcl::Matrix3<S>::Identity();
  const fcl::Vector3<S> T(0, 0, 0), mark(7, 8, 9);
  const RelativePose<S> X(R, T);
  const kIOS<S>* const pairs[3][2] = {{&empty, &point}, {&point, &empty}, {&empty, &empty}};
  for (const auto& pair : pairs) {
    const kIOS<S>&a = *pair[0], &b = *pair[1];
    EXPECT_EQ(separation(a, b, X, 0.0), std::numeric_limits<double>::infinity());
    EXPECT_FALSE(overlap(R, T, a, b));
    EXPECT_FALSE(a.overlap(b));
    fcl::Vector3<S> P = mark, Q = mark;
    EXPECT_EQ(distance(R, T, a, b, &P, &Q), std::numeric_limits<S>::max());
    EXPECT_EQ(a.distance(b, &P, &Q), std::numeric_limits<S>::max());
    EXPECT_EQ(a.distance(b), std::numeric_limits<S>::max());
    EXPECT_EQ(P, mark);
    EXPECT_EQ(Q, mark);
  }
}

template <typename S>
std::string refusal(const fcl::Matrix3<S>& R, const fcl::Vector3<S>& T) {
  try {
    kIOS<S> point;
    point += fcl::Vector3<S>(0, 0, 0);
    overlap(R, T, point, point);
  } catch (const std::invalid_argument& e) {
    return e.what();
  }
  return "";
}

TYPED_TEST(Witness, PosesThatAreNotRigidAreRefused) {
  using S = TypeParam;
  constexpr S kNan = std::numeric_limits<S>::quiet_NaN();
  constexpr S kInf = std::numeric_limits<S>::infinity();
  const fcl::Matrix3<S> I = fcl::Matrix3<S>::Identity();
  const fcl::Vector3<S> zero(0, 0, 0);
  EXPECT_EQ(refusal<S>(I, zero), "");
  for (const S bad : {kNan, kInf, -kInf}) {
    for (int c = 0; c < 3; ++c) {
      fcl::Vector3<S> T = zero;
      T[c] = bad;
      EXPECT_NE(refusal<S>(I, T).find("NaN, infinite or too large"), std::string::npos);
      fcl::Matrix3<S> R = I;
      R(c, (c + 1) % 3) = bad;
      EXPECT_NE(refusal<S>(R, zero).find("not rigid"), std::string::npos);
    }
  }
  EXPECT_NE(refusal<S>(2 * I, zero).find("not rigid: |R^T R - I| = 5.19"), std::string::npos)
      << refusal<S>(2 * I, zero);
  EXPECT_NE(refusal<S>(fcl::Matrix3<S>::Zero(), zero).find("not rigid"), std::string::npos);
  // Accepted to 1e-4 (double) or 1e-3 (float), refused clearly beyond.
  const S limit = sizeof(S) == sizeof(double) ? S(1e-4) : S(1e-3);
  fcl::Matrix3<S> sheared = I;
  sheared(0, 0) += limit / S(2.1);
  EXPECT_EQ(refusal<S>(sheared, zero), "");
  sheared(0, 0) += 2 * limit;
  EXPECT_NE(refusal<S>(sheared, zero), "");
}

TYPED_TEST(Witness, PairsOfPosesThatAreNotRigidAreRefused) {
  using S = TypeParam;
  fcl::Transform3<S> X = fcl::Transform3<S>::Identity(), Y = X;
  EXPECT_NO_THROW(RelativePose<S>(X, Y));
  Y.linear() *= S(1.01);
  EXPECT_THROW(RelativePose<S>(X, Y), std::invalid_argument);
  EXPECT_THROW(RelativePose<S>(Y, X), std::invalid_argument);
  Y = X;
  Y.translation()[1] = std::numeric_limits<S>::quiet_NaN();
  EXPECT_THROW(RelativePose<S>(X, Y), std::invalid_argument);
}

}  // namespace
}  // namespace kios::testing
