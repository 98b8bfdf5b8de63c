// SPDX-FileCopyrightText: 2026 The fcl_kios authors
// SPDX-License-Identifier: BSD-3-Clause

#include <fcl/geometry/bvh/BVH_model.h>
#include <fcl/math/bv/OBBRSS.h>
#include <fcl/narrowphase/continuous_collision.h>

#include "continuous_competitor.h"

namespace kios::bench {
namespace {

template <fcl::CCDSolverType kSolver>
class ObbrssContinuous final : public ContinuousCompetitor {
 public:
  const char* name() const override {
    return kSolver == fcl::CCDC_NAIVE ? "fcl_obbrss_sampling" : "fcl_obbrss_advancement";
  }
  bool serves(fcl::CCDMotionType type) const override {
    return kSolver == fcl::CCDC_NAIVE || type != fcl::CCDM_SPLINE;
  }
  double timeError() const override { return 1e-3; }
  void load(const scenes::Mesh& a, const scenes::Mesh& b) override {
    a_ = scenes::buildModel<fcl::OBBRSSd>(a);
    b_ = scenes::buildModel<fcl::OBBRSSd>(b);
  }
  fcl::ContinuousCollisionResultd answer(const Motions& motions) const override {
    constexpr std::size_t kSamples = 1000;
    const fcl::ContinuousCollisionRequestd request(kSamples, timeError(), fcl::CCDM_TRANS,
                                                   fcl::GST_LIBCCD, kSolver);
    fcl::ContinuousCollisionResultd result;
    fcl::continuousCollide(a_.get(), motions.a.get(), b_.get(), motions.b.get(), request, result);
    return result;
  }
  TestCounts count(const Motions& /*motions*/) const override { return {}; }

 private:
  std::shared_ptr<fcl::BVHModel<fcl::OBBRSSd>> a_, b_;
};

}  // namespace

std::unique_ptr<ContinuousCompetitor> makeObbrssSampling() {
  return std::make_unique<ObbrssContinuous<fcl::CCDC_NAIVE>>();
}
std::unique_ptr<ContinuousCompetitor> makeObbrssAdvancement() {
  return std::make_unique<ObbrssContinuous<fcl::CCDC_CONSERVATIVE_ADVANCEMENT>>();
}

}  // namespace kios::bench
