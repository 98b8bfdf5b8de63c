// SPDX-FileCopyrightText: 2026 The fcl_kios authors
// SPDX-License-Identifier: BSD-3-Clause
//
// The quick look at two central spheres proves no more than the common frame would, and proves
// what is plainly apart.
#include "volume/far_apart.h"

#include <gtest/gtest.h>

#include <limits>

#include "fcl_kios/volume/separation.h"
#include "not_finite.h"
#include "scalars.h"
#include "scenes/random.h"

namespace kios::testing {
namespace {

KIOS_SCALAR_SUITE(FarApart);

/// Holds two volumes of a sphere each, in poses that leave a given gap between them but for
/// rounding.
template <typename S>
struct Spheres {
  /// Lengths are about `size`; rotations are sheared by up to `shear`.
  Spheres(scenes::Random& random, double size, double shear, double gap) {
    const auto length = [&] { return size * std::exp2(random.uniform(-30, 0)); };
    const auto direction = [&] {
      return fcl::Vector3d(random.uniform(-1, 1), random.uniform(-1, 1), random.uniform(-1, 1))
          .normalized();
    };
    const auto volume = [&](kIOS<S>& bv) {
      bv.num_spheres = 1;
      bv.radius0 = static_cast<S>(length());
      bv.center0 = (length() * direction()).template cast<S>();
    };
    const auto rotate = [&](fcl::Transform3<S>& X) {
      const double angle = 0.5 * static_cast<int>(random.uniform(0, 8)) * std::acos(0.0);
      const fcl::AngleAxisd turn(random.unit() < 0.3 ? angle : random.uniform(0, 7), direction());
      fcl::Matrix3d R = turn.toRotationMatrix();
      for (int i = 0; i < 9; ++i) R(i / 3, i % 3) += random.uniform(-shear, shear);
      X.linear() = R.template cast<S>();
    };
    volume(a);
    volume(b);
    rotate(X_WA);
    rotate(X_WB);
    X_WA.translation() = (random.unit() < 0.5 ? length() : 0.0) * direction().template cast<S>();
    const auto c_a = center(a, X_WA);
    const fcl::Vector3d between = (double{a.radius0} + double{b.radius0} + gap) * direction();
    X_WB.translation().setZero();
    X_WB.translation() = (c_a + between - center(b, X_WB)).template cast<S>();
  }

  static fcl::Vector3d center(const kIOS<S>& bv, const fcl::Transform3<S>& X) {
    return X.linear().template cast<double>() * bv.center0.template cast<double>() +
           X.translation().template cast<double>();
  }
  bool farApart(double margin = 0) const {
    return kios::farApart<S>(CentralWay(a, X_WA, b, X_WB), squaredRotationErrors(X_WA, X_WB),
                             margin);
  }
  double separation() const {
    return kios::separation(a, b, RelativePose<S>(X_WA, X_WB), kInfinity);
  }

  kIOS<S> a, b;
  fcl::Transform3<S> X_WA = fcl::Transform3<S>::Identity(), X_WB = X_WA;
};

TYPED_TEST(FarApart, ProvesNoMoreThanTheCommonFrame) {
  using S = TypeParam;
  scenes::Random random(1);
  int proven = 0, left = 0;
  for (int i = 0; i < 300'000; ++i) {
    const double size = std::exp2(random.uniform(-90, 36));
    const double shear = random.unit() < 0.5 ? 0 : std::exp2(random.uniform(-60, -16));
    const double margin = random.unit() < 0.5 ? 0 : size * std::exp2(random.uniform(-50, 0));
    const double excess = size * std::exp2(random.uniform(-60, -4)) * random.uniform(-0.2, 1);
    const Spheres<S> spheres(random, size, shear, margin + excess);
    if (spheres.farApart(margin)) {
      ASSERT_GT(spheres.separation(), margin) << "pair " << i;
      ++proven;
    } else {
      ++left;
    }
  }
  EXPECT_GT(proven, 30'000);
  EXPECT_GT(left, 30'000);
}

TYPED_TEST(FarApart, ProvesWhatIsPlainlyApart) {
  using S = TypeParam;
  scenes::Random random(2);
  for (int i = 0; i < 20'000; ++i) {
    const double size = std::exp2(random.uniform(-60, 34));
    const Spheres<S> spheres(random, size, 0, size / 64);
    ASSERT_TRUE(spheres.farApart()) << "pair " << i;
    ASSERT_FALSE(spheres.farApart(size / 32)) << "pair " << i;
  }
}

TYPED_TEST(FarApart, LeavesToTheCommonFrameWhatItCantBound) {
  using S = TypeParam;
  scenes::Random random(3);
  const Spheres<S> good(random, 1, 0, 1);
  ASSERT_TRUE(good.farApart());
  constexpr double kBad[] = {std::numeric_limits<double>::quiet_NaN(), kInfinity, -kInfinity,
                             0x1p41, -0x1p100};
  for (const double bad : kBad) {
    for (int i = 0; i < 3; ++i) {
      Spheres<S> of_a = good, of_b = good;
      of_a.X_WA.translation()[i] = static_cast<S>(bad);
      of_b.X_WB.translation()[i] = static_cast<S>(bad);
      EXPECT_FALSE(of_a.farApart()) << bad;
      EXPECT_FALSE(of_b.farApart()) << bad;
    }
    EXPECT_FALSE(good.farApart(std::abs(bad))) << bad;
  }
  const Spheres<S> tiny(random, 0x1p-110, 0, 0x1p-110), huge(random, 0x1p42, 0, 0x1p42);
  EXPECT_FALSE(tiny.farApart());
  EXPECT_FALSE(huge.farApart());
  const Spheres<S> sheared(random, 1, 3e-5, 1);
  EXPECT_FALSE(sheared.farApart());
}

}  // namespace
}  // namespace kios::testing
