// SPDX-FileCopyrightText: 2026 The fcl_kios authors
// SPDX-License-Identifier: BSD-3-Clause

#include "fcl_kios/variants/kios_policy.h"
#include "fcl_policies.h"
#include "fit_entrant.h"

namespace kios::bench {
namespace {

constexpr double kPi = 3.14159265358979323846;

using Entrants = std::vector<std::unique_ptr<FitEntrant>>;

/// Spheres with their own radii, or with one that all but S0 share.
VolumeSize sizeOf(const kIOSd& bv, bool shared_radius) {
  const int k = bv.k();
  const bool shares = shared_radius && k > 1;
  return {shares ? 4.0 + 3 * (k - 1) + 1 : 4.0 * k, static_cast<double>(k)};
}

void addKios(Entrants& all, const std::string& name, const FitOptions& options) {
  const bool shared = options.shared_radius;
  all.push_back(std::make_unique<VariantEntrant<KiosPolicy>>(
      name, KiosPolicy(options), [shared](const kIOSd& bv) { return sizeOf(bv, shared); }));
}

/// The paper's choices of k, and angles about its pi/6, of one method.
void addChoices(Entrants& all, const std::string& name, FitMethod method) {
  FitOptions options(method);
  options.count = SphereCount::kAll;
  addKios(all, name + "_k5", options);
  options.count = SphereCount::kByGain;
  addKios(all, name + "_by_gain", options);
  options.count = SphereCount::kByRatio;
  for (const int degrees : {15, 22, 45}) {
    options.angle = degrees == 22 ? kPi / 8 : kPi * degrees / 180;
    addKios(all, name + "_" + std::to_string(degrees) + "deg", options);
  }
}

template <typename Policy>
void addOther(Entrants& all, const std::string& name, double numbers, bool serves_distance = true) {
  all.push_back(std::make_unique<VariantEntrant<Policy>>(
      name, Policy(),
      [numbers](const auto& /*bv*/) {
        return VolumeSize{numbers, 0};
      },
      serves_distance));
}

}  // namespace

std::vector<std::unique_ptr<FitEntrant>> fitEntrants() {
  Entrants all;
  addKios(all, "kios_method_i", FitMethod::kMethodI);
  addKios(all, "kios_method_ii", FitMethod::kMethodII);
  FitOptions shared(FitMethod::kMethodII);
  shared.shared_radius = true;
  addKios(all, "kios_method_ii_shared", shared);
  addChoices(all, "kios_method_ii", FitMethod::kMethodII);
  addKios(all, "kios_tuned", FitMethod::kTuned);
  shared.method = FitMethod::kTuned;
  addKios(all, "kios_tuned_shared", shared);
  addChoices(all, "kios_tuned", FitMethod::kTuned);
  // In the paper's words: centre and radius, two corners, axes and half extents, ...
  addOther<SpherePolicy>(all, "sphere", 4);
  addOther<AabbPolicy>(all, "fcl_aabb", 6);
  addOther<OrientedPolicy<fcl::OBBd>>(all, "fcl_obb", 15, false);
  addOther<OrientedPolicy<fcl::RSSd>>(all, "fcl_rss", 15);
  addOther<OrientedPolicy<fcl::OBBRSSd>>(all, "fcl_obbrss", 30);
  addOther<KdopPolicy<16>>(all, "fcl_kdop16", 16);
  addOther<KdopPolicy<18>>(all, "fcl_kdop18", 18);
  addOther<KdopPolicy<24>>(all, "fcl_kdop24", 24);
  return all;
}

}  // namespace kios::bench
