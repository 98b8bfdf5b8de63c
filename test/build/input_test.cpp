// SPDX-FileCopyrightText: 2026 The fcl_kios authors
// SPDX-License-Identifier: BSD-3-Clause
//
// Fits accept finite points of allowed size, and refuse all others.
#include <gtest/gtest.h>

#include <stdexcept>

#include "fcl_kios/paper.h"
#include "paper/all_fits.h"
#include "scalars.h"
#include "together.h"
#include "volume/exact_spheres.h"

namespace kios::testing {
namespace {

KIOS_SCALAR_SUITE(FitInput);

const std::vector<FitOptions> kFits = allFits();

TYPED_TEST(FitInput, NoPointsGiveTheEmptyVolume) {
  using S = TypeParam;
  for (const FitOptions& options : kFits) {
    kIOS<S> v;
    v += fcl::Vector3<S>(1, 2, 3);
    fit(static_cast<const fcl::Vector3<S>*>(nullptr), 0, v, options);
    EXPECT_EQ(v.k(), 0);
    EXPECT_TRUE(bitwiseEqual(v, kIOS<S>()));
  }
}

TYPED_TEST(FitInput, OnePointGivesThePoint) {
  using S = TypeParam;
  const fcl::Vector3<S> p(S(0.1), S(-2.3), S(4e7));
  for (const FitOptions& options : kFits) {
    kIOS<S> v;
    fit(&p, 1, v, options);
    EXPECT_EQ(v.k(), 1);
    EXPECT_EQ(v.center0, p);
    EXPECT_EQ(v.radius0, 0);
  }
}

/// The message with which `points` are refused, or "" if they are not; v must not change.
template <typename S>
std::string refusal(const Points<S>& points, const FitOptions& options) {
  kIOS<S> v;
  v += fcl::Vector3<S>(1, 2, 3);
  const kIOS<S> before = v;
  try {
    fit(points.data(), static_cast<int>(points.size()), v, options);
  } catch (const std::invalid_argument& e) {
    EXPECT_TRUE(bitwiseEqual(v, before));
    return e.what();
  }
  return "";
}

TYPED_TEST(FitInput, CoordinatesThatAreNotFiniteAreRefusedByName) {
  using S = TypeParam;
  Random random(1);
  const S bad[] = {std::numeric_limits<S>::quiet_NaN(), std::numeric_limits<S>::infinity(),
                   -std::numeric_limits<S>::infinity()};
  const char* const names[] = {"nan", "inf", "-inf"};
  for (int n = 1; n < 40; ++n) {
    for (int i = 0; i < 9; ++i) {
      auto points = place<S>(random, shapePoints(random, PointShape::kRandom, n), 0, 1);
      points[below(random, n)][i % 3] = bad[i / 3];
      for (const FitOptions& options : kFits) {
        const std::string message = refusal(points, options);
        EXPECT_NE(message.find("fcl_kios: "), std::string::npos) << "n = " << n;
        EXPECT_NE(message.find(names[i / 3]), std::string::npos) << message;
      }
    }
  }
}

TYPED_TEST(FitInput, CoordinatesThatAreTooLargeAreRefused) {
  using S = TypeParam;
  const bool is_double = sizeof(S) == sizeof(double);
  const S limit = static_cast<S>(std::ldexp(1.0, is_double ? 1000 : 120));
  const S beyond = std::nextafter(limit, std::numeric_limits<S>::max());
  for (int n = 1; n < 12; ++n) {
    for (int at = 0; at < n; ++at) {
      for (const S sign : {S(1), S(-1)}) {
        for (const FitOptions& options : kFits) {
          Points<S> points(n, fcl::Vector3<S>(sign * limit, 0, 0));
          EXPECT_EQ(refusal(points, options), "");
          points[at][0] = sign * beyond;
          EXPECT_NE(refusal(points, options).find(is_double ? "1.07" : "1.3"), std::string::npos)
              << "n = " << n << " at " << at << ": " << refusal(points, options);
          points[at] = fcl::Vector3<S>(0, 0, std::numeric_limits<S>::max());
          EXPECT_NE(refusal(points, options), "") << "n = " << n << " at " << at;
        }
      }
    }
  }
}

TYPED_TEST(FitInput, FoundByArgumentDependentLookup) {
  using S = TypeParam;
  Points<S> points = {{0, 0, 0}, {1, 0, 0}, {0, 1, 0}};
  kIOS<S> found, tuned;
  fit(points.data(), 3, found);
  kios::fit(points.data(), 3, tuned, FitMethod::kTuned);
  EXPECT_TRUE(bitwiseEqual(found, tuned));
}

TYPED_TEST(FitInput, ThreadsFitAlike) {
  using S = TypeParam;
  Random random(3);
  std::vector<Points<S>> sets;
  for (int i = 0; i < 500; ++i) sets.push_back(hardPointSet<S>(random, randomCount(random)));
  std::vector<kIOS<S>> results[3];
  testing::together(3, [&](int t) {
    for (const auto& points : sets) results[t].push_back(fitted(points));
  });
  for (std::size_t i = 0; i < sets.size(); ++i) {
    EXPECT_TRUE(bitwiseEqual(results[0][i], results[1][i]));
    EXPECT_TRUE(bitwiseEqual(results[0][i], results[2][i]));
  }
}

}  // namespace
}  // namespace kios::testing
