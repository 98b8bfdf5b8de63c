// SPDX-FileCopyrightText: 2026 The fcl_kios authors
// SPDX-License-Identifier: BSD-3-Clause
//
// Chords of motions and the times that slabs last, against places at random times.

#include "continuous/chords.h"

#include <cmath>

#include "continuous/motion.h"
#include "continuous/moving_meshes.h"

namespace kios::testing {
namespace {

using continuous::Chords;
using continuous::RelativeMotion;
using continuous::RelativeVelocities;

class ChordsOf : public ::testing::TestWithParam<fcl::CCDMotionType> {
 protected:
  continuous::Motion randomMotion(RandomPoses& random) const {
    if (GetParam() == fcl::CCDM_SPLINE) {
      const fcl::SplineMotion<double> spline(random.point(3), random.point(3), random.point(3),
                                             random.point(3), random.point(9), random.point(9),
                                             random.point(9), random.point(9));
      return continuous::motionOf(&spline);
    }
    return continuous::motionBetween(random.pose(2), random.pose(2), GetParam());
  }
};

/// Returns a point of a body at a time, in the frame that is body A's at t.
Vector3d placeAt(const continuous::Motion& body, const continuous::Motion& a, double t, double time,
                 const Vector3d& x) {
  return a.pose(t).inverse(Eigen::Isometry) * (body.pose(time) * x);
}

TEST_P(ChordsOf, PathsStayWithinTheirSagitta) {
  RandomPoses random(97);
  double tightest = 0;
  for (int i = 0; i < 3000; ++i) {
    const auto a = randomMotion(random), b = randomMotion(random);
    const double reach = 4, t = random(0, 0.9), h = (1 - t) * std::pow(random(0, 1), 3);
    const RelativeMotion motion(a, b, reach, reach);
    const RelativeVelocities v = motion.at(t, h);
    Chords chords;
    chords.set(motion, t, h);
    const Vector3d x = random.point(2);
    for (const bool of_a : {true, false}) {
      const auto& body = of_a ? a : b;
      const auto& field = of_a ? v.a() : v.b();
      const double acceleration = field.acceleration(of_a ? x : Vector3d(v.pose() * x));
      const double sagitta = chords.sagitta(acceleration, x.lpNorm<1>()) + v.pad();
      for (int part = 0; part < Chords::kParts; ++part) {
        const auto& from = of_a ? chords.ofA(part) : chords.ofB(part);
        const auto& to = of_a ? chords.ofA(part + 1) : chords.ofB(part + 1);
        const Vector3d begin = from.R * x + from.T, end = to.R * x + to.T;
        const double s = random(0.3, 0.7), time = t + h * (part + s) / Chords::kParts;
        const Vector3d place = placeAt(body, a, t, time, x);
        const double off = (place - begin - s * (end - begin)).norm();
        ASSERT_LE(off, sagitta) << i;
        if (sagitta > 1e-6) tightest = std::max(tightest, off / sagitta);
      }
    }
  }
  EXPECT_GE(tightest, GetParam() == fcl::CCDM_TRANS ? 0 : 0.5) << "these bounds say nothing";
}

// Both sides of a slab are looked at as vertices at random times: a slab that lasts holds them
// apart. Its time is about as long as the slab does last.
TEST_P(ChordsOf, SlabsLast) {
  RandomPoses random(97);
  double sum = 0, truth = 0;
  for (int i = 0; i < 6000; ++i) {
    const auto a = randomMotion(random), b = randomMotion(random);
    const double t = random(0, 0.9), h = (1 - t) * std::pow(random(0, 1), 3);
    const RelativeMotion motion(a, b, 4, 4);
    const RelativeVelocities v = motion.at(t, h);
    // Triangles on both sides of a plane of frame A, at t.
    const Vector3d n = random.point(1).normalized(), middle = random.point(1);
    const double gap = 0.3 * std::pow(random(0, 1), 4), size = std::pow(10, random(-2, 0));
    std::array<Vector3d, 3> p, q;
    const auto X_BA = (a.pose(t).inverse(Eigen::Isometry) * b.pose(t)).inverse(Eigen::Isometry);
    std::array<Vector3d, 3> q_in_b;
    for (int k = 0; k < 3; ++k) {
      p[k] = middle + size * random.point(1);
      p[k] -= n * std::max(0.0, n.dot(p[k] - middle));
      q[k] = middle + size * random.point(1);
      q[k] += n * (gap + std::max(0.0, -n.dot(q[k] - middle)));
      q_in_b[k] = X_BA * q[k];
    }
    const auto gapAt = [&](double time) {
      double high = -1e300, low = 1e300;
      for (int k = 0; k < 3; ++k) {
        high = std::max(high, n.dot(placeAt(a, a, t, time, p[k])));
        low = std::min(low, n.dot(placeAt(b, a, t, time, q_in_b[k])));
      }
      return low - high;
    };
    const auto support = [&](const Vector3d& m) {
      return std::max({m.dot(p[0]), m.dot(p[1]), m.dot(p[2])});
    };
    const double time = std::min(h, v.slabTime(n, support, middle, 2 * size, q, v.pad()));
    for (int k = 0; k <= 8 && time > 0; ++k) {
      ASSERT_GT(gapAt(t + std::min(h, time) * k / 8), 0) << i;
    }
    double last = 0;
    for (int k = 1; k <= 64 && gapAt(t + h * k / 64) > 0; ++k) last = h * k / 64;
    sum += std::min(time, h);
    truth += last;
  }
  std::printf("%.2f of the time\n", sum / truth);
  // Splines turn by several full turns, about axes that change.
  EXPECT_GE(sum, (GetParam() == fcl::CCDM_SPLINE ? 0.15 : 0.7) * truth);
}

INSTANTIATE_TEST_SUITE_P(Types, ChordsOf, ::testing::ValuesIn(kMotionTypes));

}  // namespace
}  // namespace kios::testing
