// SPDX-FileCopyrightText: 2026 The fcl_kios authors
// SPDX-License-Identifier: BSD-3-Clause
//
// Every sphere that a fit stores contains every point, decided in higher precision: 300,000 sets.
#include <gtest/gtest.h>

#include <map>
#include <sstream>

#include "fcl_kios/paper.h"
#include "paper/all_fits.h"
#include "scalars.h"
#include "volume/exact_spheres.h"

namespace kios::testing {
namespace {

template <typename S>
std::string describe(const Points<S>& points) {
  std::ostringstream text;
  text << std::hexfloat;
  for (std::size_t i = 0; i < points.size() && i < 8; ++i) {
    text << "(" << points[i][0] << ", " << points[i][1] << ", " << points[i][2] << ") ";
  }
  text << (points.size() > 8 ? "..." : "") << " n = " << points.size();
  return text.str();
}

/// Fits in several ways and checks the volumes; shows the first set of each kind of violation.
template <typename S>
class Checker {
 public:
  /// The tuned fit, Method II, and one of all the others in turn.
  void check(const Points<S>& points) {
    static const std::vector<FitOptions> all = allFits();
    for (const FitOptions& options :
         {FitOptions(FitMethod::kTuned), FitOptions(FitMethod::kMethodII),
          all[next_++ % all.size()]}) {
      const kIOS<S> v = fitted(points, options);
      std::string wrong = violation(v, points);
      if (wrong.empty()) wrong = measureViolation(v, points);
      if (wrong.empty()) continue;
      wrong += ", " + nameOf(options);
      if (++violations_[wrong] == 1) ADD_FAILURE() << wrong << ": " << describe(points);
    }
  }
  ~Checker() {
    for (const auto& v : violations_) ADD_FAILURE() << v.first << " in " << v.second << " sets";
  }

 private:
  std::map<std::string, int> violations_;
  std::size_t next_ = 0;
};

KIOS_SCALAR_SUITE(FitContainment);

TYPED_TEST(FitContainment, HardSetsOfAnyShapePlaceAndScale) {
  Random random(1);
  Checker<TypeParam> checker;
  for (int set = 0; set < 149'600; ++set) {
    checker.check(hardPointSet<TypeParam>(random, randomCount(random)));
  }
}

TYPED_TEST(FitContainment, LargeSets) {
  Random random(3);
  Checker<TypeParam> checker;
  for (int set = 0; set < 300; ++set) {
    checker.check(hardPointSet<TypeParam>(random, 100 + below(random, 1500)));
  }
}

// Coordinates up to the promised limit, and those that only their exponents tell apart.
TYPED_TEST(FitContainment, EndsOfTheRange) {
  using S = TypeParam;
  Random random(4);
  Checker<S> checker;
  const int top = sizeof(S) == sizeof(double) ? 1000 : 120;
  const int bottom = std::numeric_limits<S>::min_exponent - std::numeric_limits<S>::digits;
  for (int set = 0; set < 100; ++set) {
    Points<S> points(randomCount(random));
    for (auto& p : points) {
      for (S& c : p) {
        const int exponent = set % 4 == 0   ? top
                             : set % 4 == 1 ? bottom + below(random, 6)
                             : set % 4 == 2 ? (random.unit() < 0.5 ? top : bottom)
                                            : bottom + below(random, top - bottom);
        const double fraction = set % 8 == 0 ? 1 : random.uniform(0.5, 1);
        c = static_cast<S>(std::ldexp(random.unit() < 0.5 ? fraction : -fraction, exponent));
      }
    }
    checker.check(points);
  }
}

// Neither thin shapes nor offsets of 1e12 sizes may blow a volume up.
TYPED_TEST(FitContainment, RadiusStaysNearTheContentsSize) {
  using S = TypeParam;
  Random random(6);
  int too_large = 0;
  for (int set = 0; set < 30'000; ++set) {
    const auto points = hardPointSet<S>(random, randomCount(random));
    long double farthest = 0, magnitude = 0;
    for (const auto& p : points) {
      const auto from_first =
          (p.template cast<long double>() - points[0].template cast<long double>());
      farthest = std::max(farthest, from_first.norm());
      magnitude = std::max(magnitude, p.template cast<long double>().cwiseAbs().maxCoeff());
    }
    const kIOS<S> v = fitted(points);
    // The centre is rounded to S; radii of float volumes are at least 2^-126.
    const long double ulp = std::numeric_limits<S>::epsilon() * magnitude;
    const long double limit = 1.1L * farthest + 2 * ulp + 3 * std::numeric_limits<S>::min();
    if (v.radius0 <= limit) continue;
    if (++too_large == 1) ADD_FAILURE() << v.radius0 << " > " << limit << " " << describe(points);
  }
  EXPECT_EQ(too_large, 0);
}

}  // namespace
}  // namespace kios::testing
