// SPDX-FileCopyrightText: 2026 The fcl_kios authors
// SPDX-License-Identifier: BSD-3-Clause
//
// Requests, misuse, what stays untouched, threads, and FCL's continuous objects and callback.

#include <atomic>
#include <cmath>
#include <cstring>
#include <limits>

#include "continuous/moving_meshes.h"
#include "fcl/expect_refused.h"
#include "together.h"

namespace kios::testing {
namespace {

class Continuous : public ::testing::Test {
 protected:
  Continuous() : model(kiosModel(scenes::subdividedBox({2, 2, 2}, 2))) {}

  double ask(const Transform3d& X_1, fcl::ContinuousCollisionResultd& result,
             const fcl::ContinuousCollisionRequestd& request = requestFor(fcl::CCDM_LINEAR)) const {
    return fcl::continuousCollide(model.get(), at(0, 0, 0), at(0, 0, 0), model.get(), at(10, 0, 0),
                                  X_1, request, result);
  }
  std::shared_ptr<Modeld> model;
  fcl::ContinuousCollisionResultd result;
};

TEST_F(Continuous, TocErrorIsKept) {
  for (double toc_err : {1.0, 0.3, 1e-2, 1e-4, 1e-8, 1e-12, 0.0, 1e300}) {
    EXPECT_LE(ask(at(-10, 0, 0), result, requestFor(fcl::CCDM_LINEAR, toc_err)), 0.4);
    EXPECT_TRUE(result.is_collide);
    EXPECT_GE(result.time_of_contact, 0.4 - toc_err - 1e-14) << toc_err;
  }
}

TEST_F(Continuous, BadRequestsAreRefused) {
  const double nan = std::numeric_limits<double>::quiet_NaN();
  for (double toc_err : {-1e-9, nan}) {
    expectRefused([&] { ask(at(0, 0, 0), result, requestFor(fcl::CCDM_TRANS, toc_err)); },
                  "toc_err");
  }
  expectRefused([&] { ask(at(nan, 0, 0), result); }, "finite");
  Transform3d skew = at(0, 0, 0);
  skew.linear()(0, 0) = 1.1;
  expectRefused([&] { ask(skew, result); }, "rigid");
  Transform3d mirror = at(0, 0, 0);
  mirror.linear()(0, 0) = -1;
  expectRefused([&] { ask(mirror, result); }, "rigid");
  const Modeld unfinished;
  expectRefused(
      [&] {
        fcl::continuousCollide(model.get(), at(0, 0, 0), at(0, 0, 0), &unfinished, at(0, 0, 0),
                               at(0, 0, 0), requestFor(fcl::CCDM_TRANS), result);
      },
      "can't be queried");
  EXPECT_FALSE(result.is_collide) << "results stay untouched";
}

/// Stands still at first sight.
class OwnMotion : public fcl::TranslationMotiond {
 public:
  using fcl::TranslationMotiond::TranslationMotiond;
};

TEST_F(Continuous, MotionsOfOtherTypesAreRefusedByName) {
  const OwnMotion own(at(0, 0, 0), at(1, 0, 0));
  expectRefused(
      [&] {
        fcl::continuousCollide(model.get(), &own, model.get(), &own, requestFor(fcl::CCDM_TRANS),
                               result);
      },
      "OwnMotion");
  const fcl::MotionBased* none = nullptr;
  expectRefused(
      [&] {
        fcl::continuousCollide(model.get(), none, model.get(), none, requestFor(fcl::CCDM_TRANS),
                               result);
      },
      "motion");
}

// Rotations of six digits, as many files hold: taken for the nearest rotation.
TEST_F(Continuous, RotationsOfSixDigits) {
  Transform3d X_0 = at(10, 0, 0, 0.3), X_1 = at(-10, 0, 0, 0.7);
  for (Transform3d* X : {&X_0, &X_1}) {
    X->linear() = X->linear().unaryExpr([](double v) { return std::round(v * 1e6) / 1e6; });
  }
  for (auto type : kMotionTypes) {
    fcl::continuousCollide(model.get(), at(0, 0, 0), at(0, 0, 0), model.get(), X_0, X_1,
                           requestFor(type), result);
    EXPECT_TRUE(result.is_collide);
    EXPECT_NEAR(result.time_of_contact, 0.38, 0.03);
  }
}

// FCL's polynomial solver moves the caller's models; its motions keep what integrate() wrote.
TEST_F(Continuous, ModelsAndMotionsStayAsTheyAre) {
  const auto bytes = [&](const Modeld& m) {
    std::vector<char> all(sizeof(Vector3d) * m.num_vertices);
    std::memcpy(all.data(), m.vertices, all.size());
    for (int i = 0; i < m.getNumBVs(); ++i) {
      const auto* node = reinterpret_cast<const char*>(&m.getBV(i).bv.center0);
      all.insert(all.end(), node, node + sizeof(Vector3d));
    }
    return all;
  };
  const auto before = bytes(*model);
  for (auto type : kMotionTypes) {
    const Motion still = motionOf(type, at(0, 0, 0), at(0, 0, 0));
    const Motion moving = motionOf(type, at(10, 0, 0), at(-10, 0, 0, 0.5));
    const Transform3d pose = poseAt(*moving, 0.77);
    for (auto solver : kSolverTypes) {
      const double first =
          fcl::continuousCollide(model.get(), still.get(), model.get(), moving.get(),
                                 requestFor(type, 1e-4, solver), result);
      EXPECT_TRUE(result.is_collide);
      EXPECT_EQ(first, fcl::continuousCollide(model.get(), still.get(), model.get(), moving.get(),
                                              requestFor(type, 1e-4, solver), result));
      Transform3d now;
      moving->getCurrentTransform(now);
      EXPECT_EQ(now.matrix(), pose.matrix());
    }
  }
  EXPECT_EQ(bytes(*model), before);
}

// FCL's forms for objects, and its callback. FCL 0.7 has no continuous manager but the abstract
// class: whoever derives one calls the callback for pairs, as here.
TEST_F(Continuous, ObjectsAndCallback) {
  const fcl::CollisionObjectd o1(model, at(0, 0, 0)), o2(model, at(10, 0, 0));
  const auto request = requestFor(fcl::CCDM_TRANS);
  EXPECT_NEAR(fcl::continuousCollide(&o1, at(0, 0, 0), &o2, at(-10, 0, 0), request, result), 0.4,
              1e-4);
  EXPECT_TRUE(result.is_collide);

  const auto mover = [&](double y, double z) {
    return fcl::ContinuousCollisionObjectd(
        model, motionOf(fcl::CCDM_SCREW, at(10, y, z), at(-10, y, z, 0.5)));
  };
  fcl::ContinuousCollisionObjectd base(model, motionOf(fcl::CCDM_LINEAR, at(0, 0, 0), at(0, 0, 0)));
  fcl::ContinuousCollisionObjectd hit = mover(0, 0), beside = mover(0, 9), null(model);
  EXPECT_NEAR(fcl::collide(&base, &hit, request, result), 0.4, 0.01);
  EXPECT_TRUE(result.is_collide);
  EXPECT_EQ(fcl::collide(&base, &beside, request, result), 1);
  EXPECT_FALSE(result.is_collide);
  expectRefused([&] { fcl::collide(&base, &null, request, result); }, "motion");

  fcl::DefaultContinuousCollisionData<double> callback;
  callback.request = request;
  EXPECT_FALSE(fcl::DefaultContinuousCollisionFunction(&base, &hit, &callback));
  EXPECT_TRUE(callback.result.is_collide);
  EXPECT_FALSE(fcl::DefaultContinuousCollisionFunction(&base, &beside, &callback));
  EXPECT_FALSE(callback.result.is_collide) << "as in FCL, each pair overwrites the result";
}

TEST_F(Continuous, ThreadsShareModelsAndMotions) {
  const auto torus = kiosModel(scenes::bumpyTorus(800));
  std::vector<Motion> motions;
  for (int i = 0; i < 8; ++i) {
    motions.push_back(motionOf(kMotionTypes[i % 4], at(4, 0.3 * i, 0), at(-4, -0.2 * i, 0.1, 2)));
  }
  const auto answer = [&](const Modeld& m, std::size_t i) {
    fcl::ContinuousCollisionResultd r;
    return fcl::continuousCollide(&m, motions[i].get(), &m, motions[7 - i].get(),
                                  requestFor(fcl::CCDM_TRANS), r);
  };
  std::vector<double> expected;
  {
    const auto own = kiosModel(scenes::bumpyTorus(800));
    for (std::size_t i = 0; i < 8; ++i) expected.push_back(answer(*own, i));
  }
  std::atomic<int> wrong{0};
  together(8, [&](int k) {
    for (std::size_t i = 0; i < 8; ++i) {
      if (answer(*torus, (i + k) % 8) != expected[(i + k) % 8]) ++wrong;
    }
  });
  EXPECT_EQ(wrong, 0);
}

// FCL's visitor for a volume: its answer for a foreign volume is 0, a bound of nothing.
TEST_F(Continuous, MotionBoundOfAVolume) {
  const kIOSd& bv = model->getBV(0).bv;
  const Vector3d n = Vector3d(1, 2, -1).normalized();
  for (auto type : kMotionTypes) {
    const Motion motion = motionOf(type, at(1, 2, 3, 0.4), at(-1, 0.5, 2, 2));
    motion->integrate(0);
    const double bound = motion->computeMotionBound(fcl::TBVMotionBoundVisitor<kIOSd>(bv, n));
    double fastest = -1e9;
    for (int i = 0; i < 1000; ++i) {
      const Transform3d X_0 = poseAt(*motion, i * 1e-3), X_1 = poseAt(*motion, (i + 1) * 1e-3);
      for (int k = 0; k < model->num_vertices; ++k) {
        const Vector3d& y = model->vertices[k];
        fastest = std::max(fastest, n.dot(X_1 * y - X_0 * y) * 1e3);
      }
    }
    EXPECT_GE(bound, fastest - 1e-9);
    EXPECT_LE(bound, fastest + 5);
  }
}

}  // namespace
}  // namespace kios::testing
