// SPDX-FileCopyrightText: 2026 The fcl_kios authors
// SPDX-License-Identifier: BSD-3-Clause

#include "fcl_kios/model/prepare.h"
#include "ray_caster.h"

namespace kios::bench {
namespace {

class KiosCaster : public RayCaster {
 public:
  explicit KiosCaster(const scenes::Mesh& mesh) : model_(scenes::buildModel<kIOSd>(mesh)) {
    prepare(*model_);
  }

  std::string name() const override { return "kios"; }

  std::optional<CastHit> first(const Rayd& ray) override {
    const auto hit = firstHit(*model_, pose_, ray, &counts_);
    if (!hit) return std::nullopt;
    return CastHit{hit->t, hit->triangle};
  }
  bool any(const Rayd& ray) override { return anyHit(*model_, pose_, ray, &counts_); }
  void all(const Rayd& ray, std::vector<CastHit>& hits) override {
    hits.clear();
    constexpr std::size_t kAll = std::numeric_limits<std::size_t>::max();
    for (const auto& hit : allHits(*model_, pose_, ray, kAll, &counts_)) {
      hits.push_back({hit.t, hit.triangle});
    }
  }
  std::optional<SearchCounts> counts() const override { return counts_; }

 private:
  const std::shared_ptr<Modeld> model_;
  const fcl::Transform3d pose_ = fcl::Transform3d::Identity();
  SearchCounts counts_;
};

}  // namespace

std::unique_ptr<RayCaster> makeKiosCaster(const scenes::Mesh& mesh) {
  return std::make_unique<KiosCaster>(mesh);
}

#ifndef KIOS_HAVE_EMBREE
std::unique_ptr<RayCaster> makeEmbreeCaster(const scenes::Mesh&) { return nullptr; }
#endif

}  // namespace kios::bench
