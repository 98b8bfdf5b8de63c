// SPDX-FileCopyrightText: 2026 The fcl_kios authors
// SPDX-License-Identifier: BSD-3-Clause
//
// Continuous collision of two meshes over any volume, against dense sampling of the true verdict.

#include <fcl/math/motion/interp_motion.h>
#include <fcl/math/motion/screw_motion.h>
#include <fcl/math/motion/translation_motion.h>

#include "coverage/tally.h"
#include "fcl/mesh_cases.h"

namespace kios::coverage {
namespace {

using fcl::Transform3d;
using testing::Vector3d;
using Motion = std::shared_ptr<fcl::MotionBased>;

struct Case {
  std::string name;
  scenes::Mesh a, b;
  Transform3d a0, a1, b0, b1;
};

Transform3d at(const Vector3d& p, double angle = 0, const Vector3d& axis = Vector3d::UnitZ()) {
  Transform3d X = Transform3d::Identity();
  X.linear() = Eigen::AngleAxisd(angle, axis.normalized()).toRotationMatrix();
  X.translation() = p;
  return X;
}

std::vector<Case> casesOf() {
  using namespace scenes;
  const Mesh box = subdividedBox({1, 1, 1}, 1), plate = subdividedBox({2, 2, 0.01}, 1);
  const Mesh rod = subdividedBox({3, 0.05, 0.05}, 1), ball = icosphere(0.3, 1);
  std::vector<Case> cases{
      {"head-on boxes", box, box, at({-3, 0, 0}), at({3, 0.1, 0}), at({3, 0, 0.1}), at({-3, 0, 0})},
      {"thin plate", plate, ball, at({0, 0, 0}), at({0, 0, 0}), at({0.2, 0.1, -4}), at({0, 0, 4})},
      {"spinning rod", rod, ball, at({0, 0, 0}), at({0, 0, 0}, 2.5), at({0.1, 1.3, 0}),
       at({0.1, 1.2, 0})},
      {"passing by", box, ball, at({-3, 0, 0}), at({3, 0, 0}), at({0, 1.2, 0}), at({0, 1.2, 0})}};
  const auto poses = randomPoses(48, 2, 601);
  for (std::size_t i = 0; i + 3 < poses.size(); i += 4) {
    cases.push_back(
        {"random", bumpyTorus(100), ball, poses[i], poses[i + 1], poses[i + 2], poses[i + 3]});
  }
  return cases;
}

Motion motionOf(fcl::CCDMotionType type, const Transform3d& X0, const Transform3d& X1) {
  if (type == fcl::CCDM_TRANS) return std::make_shared<fcl::TranslationMotiond>(X0, X1);
  if (type == fcl::CCDM_LINEAR) {
    // The form that sets every member.
    return std::make_shared<fcl::InterpMotion<double>>(X0.linear(), X0.translation(), X1.linear(),
                                                       X1.translation(), Vector3d::Zero());
  }
  return std::make_shared<fcl::ScrewMotion<double>>(X0, X1);
}

Transform3d poseAt(const Motion& motion, double t) {
  Transform3d X;
  motion->integrate(t);
  motion->getCurrentTransform(X);
  return X;
}

constexpr int kSamples = 300;

// The first sample that collides, kSamples + 1 if none; and how near the others come.
struct Truth {
  int first = kSamples + 1;
  double least = 1e300;
};
Truth truthOf(const scenes::MeshOracle& oracle, const Motion& a, const Motion& b) {
  Truth truth;
  for (int i = 0; i <= kSamples; ++i) {
    const double d =
        oracle.distance(poseAt(a, double(i) / kSamples), poseAt(b, double(i) / kSamples));
    truth.least = std::min(truth.least, d);
    if (d > 0) continue;
    truth.first = i;
    break;
  }
  return truth;
}

// Of all cases; sampled once for all volumes and solvers.
const std::vector<Truth>& truthsOf(fcl::CCDMotionType type) {
  static std::map<fcl::CCDMotionType, std::vector<Truth>> truths;
  std::vector<Truth>& known = truths[type];
  if (!known.empty()) return known;
  for (const Case& c : casesOf()) {
    const scenes::MeshOracle oracle(c.a, c.b);
    known.push_back(truthOf(oracle, motionOf(type, c.a0, c.a1), motionOf(type, c.b0, c.b1)));
  }
  return known;
}

template <typename BV>
void checkMotion(fcl::CCDSolverType solver, const std::string& solver_name, fcl::CCDMotionType type,
                 const std::string& motion_name) {
  const std::vector<Case> cases = casesOf();
  for (std::size_t i = 0; i < cases.size(); ++i) {
    const Case& c = cases[i];
    const Truth truth = truthsOf(type)[i];
    const bool hits = truth.first <= kSamples;
    if (!hits && truth.least < 0.02) continue;  // sampling can't tell
    // Built for each query: FCL's polynomial solver moves the models.
    const auto model_a = scenes::buildModel<BV>(c.a), model_b = scenes::buildModel<BV>(c.b);
    const std::vector<Vector3d> before(model_a->vertices,
                                       model_a->vertices + model_a->num_vertices);
    const fcl::ContinuousCollisionRequestd request(10, 1e-3, type, fcl::GST_LIBCCD, solver);
    fcl::ContinuousCollisionResultd result;
    const double toc =
        fcl::continuousCollide(model_a.get(), motionOf(type, c.a0, c.a1).get(), model_b.get(),
                               motionOf(type, c.b0, c.b1).get(), request, result);
    const std::string row = solver_name + ", " + motion_name;
    check<BV>(row + " verdict", result.is_collide == hits, c.name);
    const double late = double(truth.first) / kSamples + 1e-3;
    const double early = truth.first == 0 ? 0 : double(truth.first - 1) / kSamples - 2e-3;
    check<BV>(row + " time",
              !hits || (result.is_collide && result.time_of_contact <= late &&
                        result.time_of_contact >= early && toc == result.time_of_contact),
              c.name + " at " + std::to_string(result.time_of_contact) + " for " +
                  std::to_string(double(truth.first) / kSamples));
    check<BV>(row + " leaves the models alone",
              std::equal(before.begin(), before.end(), model_a->vertices));
  }
}

template <typename BV>
class Continuous : public ::testing::Test {
 protected:
  // FCL tells of what it lacks on stderr, thousands of times.
  void SetUp() override { ::testing::internal::CaptureStderr(); }
  void TearDown() override { ::testing::internal::GetCapturedStderr(); }
};
TYPED_TEST_SUITE(Continuous, DoubleVolumes);

TYPED_TEST(Continuous, Naive) {
  checkMotion<TypeParam>(fcl::CCDC_NAIVE, "naive", fcl::CCDM_TRANS, "translation");
  checkMotion<TypeParam>(fcl::CCDC_NAIVE, "naive", fcl::CCDM_LINEAR, "linear");
  checkMotion<TypeParam>(fcl::CCDC_NAIVE, "naive", fcl::CCDM_SCREW, "screw");
}

TYPED_TEST(Continuous, ConservativeAdvancement) {
  const auto kSolver = fcl::CCDC_CONSERVATIVE_ADVANCEMENT;
  checkMotion<TypeParam>(kSolver, "advancement", fcl::CCDM_TRANS, "translation");
  checkMotion<TypeParam>(kSolver, "advancement", fcl::CCDM_LINEAR, "linear");
  checkMotion<TypeParam>(kSolver, "advancement", fcl::CCDM_SCREW, "screw");
}

TYPED_TEST(Continuous, Polynomial) {
  checkMotion<TypeParam>(fcl::CCDC_POLYNOMIAL_SOLVER, "polynomial", fcl::CCDM_TRANS, "translation");
}

TEST(ContinuousOfFcl, NaiveIsSeenToTunnel) { expectSeen("naive, translation verdict"); }
TEST(ContinuousOfFcl, AdvancementIsSeenWrong) { expectSeen("advancement, translation verdict"); }
TEST(ContinuousOfFcl, PolynomialIsSeenToMoveModels) {
  expectSeen("polynomial, translation leaves the models alone");
}

}  // namespace
}  // namespace kios::coverage
