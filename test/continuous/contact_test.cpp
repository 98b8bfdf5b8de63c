// SPDX-FileCopyrightText: 2026 The fcl_kios authors
// SPDX-License-Identifier: BSD-3-Clause
//
// First contacts whose times are known, through fcl::continuousCollide: the cases that FCL's own
// continuous collision misses (FCL 0.7: no head-on contact of meshes is found).

#include <cmath>

#include "continuous/moving_meshes.h"

namespace kios::testing {
namespace {

struct Form {
  fcl::CCDMotionType motion;
  fcl::CCDSolverType solver;
};

class FirstContact : public ::testing::TestWithParam<Form> {
 protected:
  fcl::ContinuousCollisionResultd ask(const Mesh& a, const Transform3d& a0, const Transform3d& a1,
                                      const Mesh& b, const Transform3d& b0, const Transform3d& b1,
                                      double toc_err = 1e-6) const {
    fcl::ContinuousCollisionResultd result;
    const double toc =
        fcl::continuousCollide(kiosModel(a).get(), a0, a1, kiosModel(b).get(), b0, b1,
                               requestFor(GetParam().motion, toc_err, GetParam().solver), result);
    EXPECT_EQ(toc, result.time_of_contact);
    return result;
  }
};

TEST_P(FirstContact, HeadOnBoxes) {
  const Mesh box = scenes::subdividedBox({2, 2, 2}, 2);
  const auto result = ask(box, at(0, 0, 0), at(0, 0, 0), box, at(10, 0, 0), at(-10, 0, 0));
  EXPECT_TRUE(result.is_collide);
  EXPECT_LE(result.time_of_contact, 0.4);
  EXPECT_GE(result.time_of_contact, 0.4 - 1e-6);
  EXPECT_NEAR(result.contact_tf2.translation().x(), 2, 21e-6);
}

TEST_P(FirstContact, ThinPlatesDontTunnel) {
  const Mesh plate = scenes::subdividedBox({2, 2, 1e-6}, 2);
  const auto result =
      ask(plate, at(0, 0, 0), at(0, 0, 0), plate, at(0.3, 0.2, 1000), at(0.3, 0.2, -3000));
  EXPECT_TRUE(result.is_collide);
  EXPECT_NEAR(result.time_of_contact, 0.25, 2e-6);
  const auto beside =
      ask(plate, at(0, 0, 0), at(0, 0, 0), plate, at(2.01, 0, 1000), at(2.01, 0, -3000));
  EXPECT_FALSE(beside.is_collide);
  EXPECT_EQ(beside.time_of_contact, 1);
}

TEST_P(FirstContact, GrazingPassesAreFree) {
  const Mesh box = scenes::subdividedBox({2, 2, 2}, 3);
  for (double gap : {1e-3, 1e-6, 1e-9}) {
    const auto free =
        ask(box, at(0, 0, 0), at(0, 0, 0), box, at(10, 0, 2 + gap), at(-10, 0, 2 + gap));
    EXPECT_FALSE(free.is_collide) << gap;
    const auto hit =
        ask(box, at(0, 0, 0), at(0, 0, 0), box, at(10, 0, 2 - gap), at(-10, 0, 2 - gap));
    EXPECT_TRUE(hit.is_collide) << gap;
    EXPECT_NEAR(hit.time_of_contact, 0.4, 2e-6);
  }
}

TEST_P(FirstContact, ContactAtTheStartIsAtZero) {
  const Mesh box = scenes::subdividedBox({2, 2, 2}, 1);
  const auto overlapping = ask(box, at(0, 0, 0), at(5, 0, 0), box, at(1, 0, 0), at(-7, 0, 0));
  EXPECT_TRUE(overlapping.is_collide);
  EXPECT_EQ(overlapping.time_of_contact, 0);
  // Touching counts, also if they part at once.
  const auto parting = ask(box, at(0, 0, 0), at(-5, 0, 0), box, at(2, 0, 0), at(7, 0, 0));
  EXPECT_TRUE(parting.is_collide);
  EXPECT_EQ(parting.time_of_contact, 0);
}

TEST_P(FirstContact, WithoutMotionItIsTheStaticAnswer) {
  const Mesh box = scenes::subdividedBox({2, 2, 2}, 1);
  const auto touching = ask(box, at(0, 0, 0), at(0, 0, 0), box, at(2, 0, 0), at(2, 0, 0));
  EXPECT_TRUE(touching.is_collide);
  for (double gap : {1e-15, 1e-9, 1.0}) {
    const auto apart =
        ask(box, at(0, 0, 0), at(0, 0, 0), box, at(2 + gap, 0, 0), at(2 + gap, 0, 0));
    EXPECT_FALSE(apart.is_collide) << gap;
  }
}

TEST_P(FirstContact, ContactAtTheVeryEnd) {
  const Mesh box = scenes::subdividedBox({2, 2, 2}, 1);
  const auto hit = ask(box, at(0, 0, 0), at(0, 0, 0), box, at(6, 0, 0), at(2, 0, 0));
  EXPECT_TRUE(hit.is_collide);
  EXPECT_NEAR(hit.time_of_contact, 1, 1e-6);
  const auto free = ask(box, at(0, 0, 0), at(0, 0, 0), box, at(6, 0, 0), at(2.000001, 0, 0));
  EXPECT_FALSE(free.is_collide);
}

std::vector<Form> forms() {
  std::vector<Form> all;
  for (auto motion : kMotionTypes) {
    for (auto solver : kSolverTypes) all.push_back({motion, solver});
  }
  return all;
}
INSTANTIATE_TEST_SUITE_P(MotionsAndSolvers, FirstContact, ::testing::ValuesIn(forms()));

// A rod that turns four times while another thin rod stands where it sweeps through.
TEST(SpinningRods, DontTunnel) {
  const Mesh rod = scenes::subdividedBox({4, 0.01, 0.01}, 1);
  const Mesh post = scenes::subdividedBox({0.01, 0.01, 2}, 1);
  const Pair pair(rod, post);
  const double turns = 4 * 2 * M_PI;
  const Vector3d z = Vector3d::UnitZ(), zero = Vector3d::Zero();
  const fcl::SplineMotion<double> spin(zero, zero, zero, zero, -0.5 * z, turns / 3 * z - 0.5 * z,
                                       turns * 2 / 3 * z - 0.5 * z, turns * z - 0.5 * z);
  for (double x : {1.9, -1.5, 2.2}) {
    const auto still = motionOf(fcl::CCDM_TRANS, at(x, 0.3, 0), at(x, 0.3, 0));
    const Answer answer = ask(pair, spin, *still, 1e-5);
    EXPECT_EQ(answer.result.is_collide, std::abs(x) < 2);
    expectRight({*pair.a, spin, *pair.b, *still}, answer.result, 1e-5, 4000, 6e-8);
    EXPECT_LT(answer.counts.steps, 500);
  }
}

// A body that slides at a small gap takes few steps, however small the gap.
TEST(Sliding, TakesFewSteps) {
  const Mesh table = scenes::subdividedBox({6, 6, 1}, 8), box = scenes::subdividedBox({1, 1, 1}, 4);
  const Pair pair(table, box);
  for (double gap : {1e-3, 1e-6, 1e-9, 1e-12}) {
    const double z = 1 + gap;
    const auto still = motionOf(fcl::CCDM_TRANS, at(0, 0, 0), at(0, 0, 0));
    const auto slide = motionOf(fcl::CCDM_TRANS, at(-2, -1, z), at(2, 1.5, z));
    const auto turn = motionOf(fcl::CCDM_LINEAR, at(-2, -1, z), at(2, 1.5, z, 3));
    const Vector3d o = Vector3d::UnitZ();
    const Motion curve = std::make_shared<fcl::SplineMotion<double>>(
        Vector3d(-3, 0, z), Vector3d(-1, 2, z), Vector3d(1, -2, z), Vector3d(3, 1, z), -1 * o,
        2 * o, 9 * o, 10 * o);
    for (const auto& motion : {slide, turn, curve}) {
      const Answer answer = ask(pair, *still, *motion, 1e-4);
      EXPECT_FALSE(answer.result.is_collide) << gap;
      EXPECT_LE(answer.counts.steps, motion == curve ? 60 : 40) << gap;
      RecordProperty("leaf_tests", static_cast<int>(answer.counts.leaf_tests));
      std::printf("gap %g: %lld steps, %lld volume tests, %lld leaf tests\n", gap,
                  answer.counts.steps, answer.counts.volume_tests, answer.counts.leaf_tests);
    }
  }
}

}  // namespace
}  // namespace kios::testing
