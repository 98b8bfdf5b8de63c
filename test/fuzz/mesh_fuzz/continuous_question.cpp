// SPDX-FileCopyrightText: 2026 The fcl_kios authors
// SPDX-License-Identifier: BSD-3-Clause
//
// kios::firstContact of two meshes, against samples of the time by the triangle kernels: no
// contact is missed, none reported late, none where the meshes are far apart.

#include "continuous/moving_meshes.h"
#include "fcl_kios/motion.h"
#include "fuzz/mesh_fuzz/pair.h"
#include "fuzz/mesh_fuzz/questions.h"

namespace kios::fuzz {
namespace {

class ContinuousQuestion {
 public:
  explicit ContinuousQuestion(const Case& c) : random_(c.draw), case_(c), pair_(c) {}

  Verdict run() {
    const auto type = testing::kMotionTypes[below(random_, 4)];
    // Quaternions take the place of matrices that are rotations to a few digits only.
    for (const auto& frame : case_.frames) {
      for (const Transform3d& X : frame) {
        if (skewOf(X) > 1e-14) return std::nullopt;
      }
    }
    // A spline that stands still gets the static answer, its samples round anew each time.
    const bool moves = case_.pose(0, 0).matrix() != case_.pose(0, 1).matrix() ||
                       case_.pose(1, 0).matrix() != case_.pose(1, 1).matrix();
    if (type == fcl::CCDM_SPLINE && !moves) return std::nullopt;
    const auto motion_a = testing::motionOf(type, case_.pose(0, 0), case_.pose(0, 1));
    const auto motion_b = testing::motionOf(type, case_.pose(1, 0), case_.pose(1, 1));
    const double toc_err = power(random_, -6, -2);
    auto request = testing::requestFor(type, toc_err);
    fcl::ContinuousCollisionResultd result;
    ContinuousCounts counts;
    firstContact(*pair_.A, motion_a.get(), *pair_.B, motion_b.get(), request, result, &counts);
    const double toc = result.time_of_contact;
    const std::string call = "testing::motionOf(" + std::to_string(static_cast<int>(type)) +
                             ", X[i], X1[i]) for both; toc_err = " + literal(toc_err) +
                             "; kios::firstContact";
    if (!(toc >= 0 && toc <= 1) || (!result.is_collide && toc != 1)) {
      return failure(Words() << "time of contact " << toc << ", collide " << result.is_collide,
                     call);
    }
    const int samples =
        case_.meshes[0].triangles.size() * case_.meshes[1].triangles.size() < 100 ? 48 : 12;
    double first = 2;
    for (int i = 0; i <= samples && first > 1; ++i) {
      const double t = static_cast<double>(i) / samples;
      if (distanceAt(*motion_a, *motion_b, t) == 0) first = t;
    }
    if (first < toc || (first <= 1 && !result.is_collide)) {
      return failure(Words() << "contact at " << first << ", told " << toc << ", collide "
                             << result.is_collide,
                     call);
    }
    if (!result.is_collide || first <= toc + toc_err) return std::nullopt;
    // Such count as contact.
    if (counts.steps > 20000 || counts.volume_tests + counts.leaf_tests > 1 << 21) {
      return std::nullopt;
    }
    // A contact between samples, or so near that no interval of toc_err / 2^20 is proven free.
    const double speed = speedOf();
    double least = distanceAt(*motion_a, *motion_b, toc);
    for (int i = 1; i <= 32 && least > 0; ++i) {
      const double t = std::min(1.0, toc + toc_err * i / 32);
      least = std::min(least, distanceAt(*motion_a, *motion_b, t));
    }
    const double bound = speed * toc_err / 32 + 0x1p-40 * reach_;
    if (least <= bound) return std::nullopt;
    return failure(Words() << "told contact at " << toc << ", where the distance is " << least
                           << ", allowed " << bound << "; " << counts.steps << " steps, "
                           << counts.volume_tests << " volume tests, " << counts.leaf_tests
                           << " leaf tests",
                   call);
  }

 private:
  double distanceAt(const fcl::MotionBased& a, const fcl::MotionBased& b, double t) {
    const BruteForce<double> truth(case_.meshes[0], testing::poseAt(a, t), case_.meshes[1],
                                   testing::poseAt(b, t));
    return truth.hits.empty() ? truth.distance : 0;
  }

  /// Bounds the speed of all points, splines' included.
  double speedOf() {
    double speed = 0;
    for (std::size_t m = 0; m < 2; ++m) {
      double most = 0;
      for (const Vector3d& p : case_.meshes[m].vertices) most = std::max(most, p.norm());
      const Transform3d &X0 = case_.pose(m, 0), &X1 = case_.pose(m, 1);
      // FCL's screws that don't turn go |way| times too far.
      const double way = (X1.translation() - X0.translation()).norm();
      speed += 10 * way * std::max(1.0, way) + 40 * most;
      reach_ += most + X0.translation().norm() + X1.translation().norm();
    }
    return speed;
  }

  Random random_;
  const Case& case_;
  const ModelPair<double> pair_;
  double reach_ = 0;
};

}  // namespace

Verdict askContinuous(const Case& c) { return ContinuousQuestion(c).run(); }

}  // namespace kios::fuzz
