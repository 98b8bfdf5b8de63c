// SPDX-FileCopyrightText: 2026 The fcl_kios authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <gtest/gtest.h>

#include <algorithm>
#include <cstdint>
#include <cstdio>
#include <memory>
#include <random>
#include <string>
#include <vector>

#include "fcl/mesh_cases.h"
#include "scenes/oracle.h"

// Moving meshes and their dense sampling, which the tests of continuous collision share.

namespace kios::testing {

using Motion = std::shared_ptr<fcl::MotionBased>;

inline constexpr fcl::CCDMotionType kMotionTypes[] = {fcl::CCDM_TRANS, fcl::CCDM_LINEAR,
                                                      fcl::CCDM_SCREW, fcl::CCDM_SPLINE};
inline constexpr fcl::CCDSolverType kSolverTypes[] = {
    fcl::CCDC_NAIVE, fcl::CCDC_CONSERVATIVE_ADVANCEMENT, fcl::CCDC_RAY_SHOOTING,
    fcl::CCDC_POLYNOMIAL_SOLVER};

inline fcl::ContinuousCollisionRequestd requestFor(
    fcl::CCDMotionType motion, double toc_err = 1e-4,
    fcl::CCDSolverType solver = fcl::CCDC_CONSERVATIVE_ADVANCEMENT) {
  return {10, toc_err, motion, fcl::GST_LIBCCD, solver};
}

inline Transform3d at(double x, double y, double z, double angle = 0,
                      const Vector3d& axis = Vector3d::UnitZ()) {
  Transform3d X = Transform3d::Identity();
  X.linear() = Eigen::AngleAxisd(angle, axis.normalized()).toRotationMatrix();
  X.translation() = Vector3d(x, y, z);
  return X;
}

struct RandomPoses {
  std::mt19937_64 engine;

  explicit RandomPoses(std::uint64_t seed) : engine(seed) {}
  double operator()(double low, double high) {
    return std::uniform_real_distribution<double>(low, high)(engine);
  }
  Vector3d point(double far) {
    return {(*this)(-far, far), (*this)(-far, far), (*this)(-far, far)};
  }
  Transform3d pose(double far) {
    const Vector3d p = point(far);
    return at(p.x(), p.y(), p.z(), (*this)(-3.1, 3.1), point(1));
  }
};

/// Returns FCL's own pose at t, by its own object.
inline Transform3d poseAt(const fcl::MotionBased& motion, double t) {
  Transform3d X;
  motion.integrate(t);
  motion.getCurrentTransform(X);
  return X;
}

/// Holds two geometries in motion, to be asked by static queries at any time.
struct Sampling {
  const fcl::CollisionGeometryd& first;
  const fcl::MotionBased& motion1;
  const fcl::CollisionGeometryd& second;
  const fcl::MotionBased& motion2;

  bool touchAt(double t) const {
    fcl::CollisionResultd contacts;
    return fcl::collide(&first, poseAt(motion1, t), &second, poseAt(motion2, t),
                        fcl::CollisionRequestd(), contacts) > 0;
  }
  double distanceAt(double t) const {
    fcl::DistanceResultd result;
    return fcl::distance(&first, poseAt(motion1, t), &second, poseAt(motion2, t),
                         fcl::DistanceRequestd(), result);
  }
};

/// Returns FCL's motion between two poses; splines in de Boor points, as its constructor is empty.
inline Motion motionOf(fcl::CCDMotionType type, const Transform3d& X_0, const Transform3d& X_1) {
  switch (type) {
    case fcl::CCDM_TRANS:
      return std::make_shared<fcl::TranslationMotiond>(X_0, X_1);
    case fcl::CCDM_LINEAR:
      return std::make_shared<fcl::InterpMotion<double>>(
          X_0.linear(), X_0.translation(), X_1.linear(), X_1.translation(), Vector3d::Zero());
    case fcl::CCDM_SCREW:
      return std::make_shared<fcl::ScrewMotion<double>>(X_0, X_1);
    default:
      break;
  }
  const auto vectorOf = [](const Transform3d& X) {
    const Eigen::AngleAxisd aa(X.linear());
    return Vector3d(aa.angle() * aa.axis());
  };
  const Vector3d T0 = X_0.translation(), T1 = X_1.translation();
  const Vector3d w0 = vectorOf(X_0), w1 = vectorOf(X_1);
  return std::make_shared<fcl::SplineMotion<double>>(T0 - (T1 - T0), T0, T1, T1 + (T1 - T0),
                                                     w0 - (w1 - w0), w0, w1, w1 + (w1 - w0));
}

struct Pair {
  explicit Pair(const Mesh& mesh_a, const Mesh& mesh_b)
      : a(kiosModel(mesh_a)), b(kiosModel(mesh_b)) {}
  std::shared_ptr<Modeld> a, b;
};

struct Answer {
  fcl::ContinuousCollisionResultd result;
  ContinuousCounts counts;
};

inline Answer ask(const Pair& pair, const fcl::MotionBased& a, const fcl::MotionBased& b,
                  double toc_err) {
  Answer answer;
  const double returned =
      firstContact(*pair.a, &a, *pair.b, &b, requestFor(fcl::CCDM_TRANS, toc_err), answer.result,
                   &answer.counts);
  EXPECT_EQ(returned, answer.result.time_of_contact);
  return answer;
}

/// Asks in both orders, which must give one answer.
inline fcl::ContinuousCollisionResultd askBoth(const fcl::CollisionGeometryd& a,
                                               const fcl::MotionBased& motion_a,
                                               const fcl::CollisionGeometryd& b,
                                               const fcl::MotionBased& motion_b, double toc_err,
                                               ContinuousCounts* counts = nullptr) {
  fcl::ContinuousCollisionResultd forth, back;
  const auto request = requestFor(fcl::CCDM_TRANS, toc_err);
  const double toc = firstContact(a, &motion_a, b, &motion_b, request, forth, counts);
  EXPECT_EQ(toc, forth.time_of_contact);
  EXPECT_EQ(toc, fcl::continuousCollide(&b, &motion_b, &a, &motion_a, request, back));
  EXPECT_EQ(forth.is_collide, back.is_collide);
  EXPECT_EQ(forth.contact_tf1.matrix(), back.contact_tf2.matrix());
  return forth;
}

/// Holds the outcomes of random motions, of which some must hit and others miss.
struct Outcomes {
  int hits = 0, queries = 0;
  ContinuousCounts counts;

  void expectBothKinds() const {
    EXPECT_GT(hits, queries / 10);
    EXPECT_LT(hits, queries * 9 / 10);
    std::printf("%d of %d hit; a query: %lld steps, %lld volume tests, %lld leaf tests\n", hits,
                queries, counts.steps / queries, counts.volume_tests / queries,
                counts.leaf_tests / queries);
  }
};

/// Checks an answer against the contacts at `samples` + 1 times: none before the time of contact,
/// and one no later than toc_err after it. Contacts too short for the samples are looked for by
/// distance: at the time of contact the pair must be within `near`.
inline void expectRight(const Sampling& at, const fcl::ContinuousCollisionResultd& result,
                        double toc_err, int samples, double near) {
  double first = 2;
  for (int i = 0; i <= samples && first > 1; ++i) {
    const double t = static_cast<double>(i) / samples;
    if (at.touchAt(t)) first = t;
  }
  if (!result.is_collide) {
    EXPECT_EQ(first, 2) << "missed a contact";
    EXPECT_EQ(result.time_of_contact, 1);
    return;
  }
  const double toc = result.time_of_contact;
  EXPECT_GE(toc, 0);
  EXPECT_LE(toc, first) << "later than a contact";
  EXPECT_TRUE(result.contact_tf1.isApprox(poseAt(at.motion1, toc), 1e-12));
  EXPECT_TRUE(result.contact_tf2.isApprox(poseAt(at.motion2, toc), 1e-12));
  if (first <= toc + toc_err) return;
  for (int i = 0; i <= 64; ++i) {
    if (at.touchAt(std::min(1.0, toc + toc_err * i / 64))) return;
  }
  EXPECT_LE(at.distanceAt(toc), near) << "no contact is near";
}

}  // namespace kios::testing
