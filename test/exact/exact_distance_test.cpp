// SPDX-FileCopyrightText: 2026 The fcl_kios authors
// SPDX-License-Identifier: BSD-3-Clause
//
// The exact distance of two k-IOS against convex optimisation in long double, and between the
// conservative bound and the distance of the contents in 100 digits.
#include "fcl_kios/bv/exact_distance.h"

#include <gtest/gtest.h>

#include "bv/exact_pairs.h"
#include "exact/interior_point.h"

namespace kios::test {
namespace {

constexpr double kInfinity = std::numeric_limits<double>::infinity();

template <typename S>
class Exact2 : public testing::Test {};
using Scalars = testing::Types<double, float>;
TYPED_TEST_SUITE(Exact2, Scalars);

template <typename S>
Real3 centroid(const Points<S>& points, const kIOS<S>& v) {
  Real3 sum = Real3::Zero();
  for (const auto& p : points) {
    sum += p.template cast<Real>() - v.center0.template cast<Real>();
  }
  return sum / static_cast<Real>(points.size());
}

TYPED_TEST(Exact2, AgreesWithInteriorPoint) {
  using S = TypeParam;
  Random random(11);
  int checked = 0, apart = 0, loose = 0, skipped = 0, wide = 0;
  double worst_low = 0, worst_high = 0, worst_error = 0;
  for (int i = 0; i < 4000; ++i) {
    const HardPair<S> pair(random);
    const RelativePose<S> X(pair.R, pair.T);
    const ExactDistance exact = exactDistance(pair.a, pair.b, X);
    const StoredBalls a(pair.a), b(pair.b);
    const Real33 R = pair.R.template cast<Real>();
    const Real3 d = R * b.center0 + pair.T.template cast<Real>() - a.center0;
    const Real3 x = centroid(pair.points_a, pair.a), w = centroid(pair.points_b, pair.b);
    const Real size = pair.reaches();
    if (size < 1e-290L) {
      ++skipped;
      continue;
    }
    if (!(a.outside(x) < -1e-15L * size) || !(b.outside(w) < -1e-15L * size)) {
      ++skipped;
      continue;
    }
    const Bracket truth = interiorPointDistance(a, b, R, d, x, w);
    const Real pad = pair.rounding() * pair.magnitude();
    const Real scale = size + 64 * pad / 1e-13L;
    if (truth.upper - truth.lower > 1e-9L * size) ++wide;
    worst_high = std::max<double>(worst_high, (exact.distance - truth.upper) / scale);
    worst_low = std::max<double>(worst_low, (truth.lower - exact.distance) / scale);
    worst_error = std::max<double>(worst_error, exact.error / scale);
    if ((truth.lower - exact.distance) > 1e-13L * scale || exact.error > 1e-13L * scale) {
      ++loose;
      if (loose < 12)
        std::printf(
            "  %d: d=%.17g err=%.3g truth [%.17Lg %.17Lg] size %.3Lg k %d %d r0 %g %g pad %.3Lg "
            "sep %g\n",
            i, exact.distance, exact.error, truth.lower, truth.upper, size, pair.a.k(), pair.b.k(),
            double(pair.a.radius0), double(pair.b.radius0), pad,
            separation(pair.a, pair.b, X, kInfinity));
    }
    ++checked;
    apart += exact.apart();
  }
  std::printf("checked %d apart %d loose %d skipped %d wide %d high %.3g low %.3g error %.3g\n",
              checked, apart, loose, skipped, wide, worst_high, worst_low, worst_error);
}

}  // namespace
}  // namespace kios::test
