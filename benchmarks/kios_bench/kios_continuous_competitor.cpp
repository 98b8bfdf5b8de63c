// SPDX-FileCopyrightText: 2026 The fcl_kios authors
// SPDX-License-Identifier: BSD-3-Clause

#include "continuous_competitor.h"
#include "fcl_kios/continuous.h"
#include "fcl_kios/fcl/model.h"

namespace kios::bench {
namespace {

class KiosContinuous final : public ContinuousCompetitor {
 public:
  const char* name() const override { return "kios"; }
  bool serves(fcl::CCDMotionType /*type*/) const override { return true; }
  double timeError() const override { return 1e-4; }
  void load(const scenes::Mesh& a, const scenes::Mesh& b) override {
    a_ = scenes::buildModel<kIOSd>(a);
    b_ = scenes::buildModel<kIOSd>(b);
  }
  fcl::ContinuousCollisionResultd answer(const Motions& motions) const override {
    return find(motions, nullptr);
  }
  TestCounts count(const Motions& motions) const override {
    ContinuousCounts counts;
    find(motions, &counts);
    return {counts.volume_tests, counts.leaf_tests};
  }

 private:
  fcl::ContinuousCollisionResultd find(const Motions& motions, ContinuousCounts* counts) const {
    const fcl::ContinuousCollisionRequestd request(10, timeError());
    fcl::ContinuousCollisionResultd result;
    firstContact(*a_, motions.a.get(), *b_, motions.b.get(), request, result, counts);
    return result;
  }

  std::shared_ptr<Modeld> a_, b_;
};

}  // namespace

std::unique_ptr<ContinuousCompetitor> makeKiosContinuous() {
  return std::make_unique<KiosContinuous>();
}

}  // namespace kios::bench
