// SPDX-FileCopyrightText: 2026 The fcl_kios authors
// SPDX-License-Identifier: BSD-3-Clause

#include "fit_entrant.h"

#include <cmath>
#include <limits>
#include <utility>

#include "fcl_kios/paper/fit.h"
#include "paper/fcl_policies.h"
#include "paper/kios_policy.h"
#include "paper/packed_policy.h"

namespace kios::bench {
namespace {

using namespace paper;

constexpr double kPi = 3.14159265358979323846;

using Entrants = std::vector<FitEntrant>;

/// Numbers that describe a volume, and its spheres.
struct VolumeSize {
  double numbers = 0;
  double spheres = 0;
};

/// size_of(stored volume) is its VolumeSize.
template <typename Policy, typename SizeOf>
void add(Entrants& all, const std::string& name, const Policy& policy, SizeOf size_of,
         bool serves_distance = true) {
  using Tree = VariantTree<Policy>;
  const auto build = [policy, size_of](const Split& split_a, const Split& split_b) {
    const auto a = std::make_shared<const Tree>(split_a, policy);
    const auto b = std::make_shared<const Tree>(split_b, policy);
    FitTrees trees;
    trees.distance = [a, b](const RelativePose<double>& X_AB) { return a->distance(*b, X_AB); };
    trees.collide = [a, b](const RelativePose<double>& X_AB) { return a->collide(*b, X_AB); };
    trees.bound = [a, b](const NodePair& pair) {
      return a->policy().separation(a->store()[pair.a], b->store()[pair.b],
                                    a->policy().place(a->shared(), b->shared(), pair.X_AB),
                                    std::numeric_limits<double>::infinity());
    };
    trees.size = [a, b, size_of] {
      FitSize mean;
      double nodes = 0, floats = 0;
      for (const Tree* tree : {a.get(), b.get()}) {
        const auto count = static_cast<int>(tree->split().nodes().size());
        for (int i = 0; i < count; ++i) {
          const VolumeSize size = size_of(tree->store()[i]);
          mean.numbers += size.numbers;
          mean.spheres += size.spheres;
        }
        nodes += count;
        floats += static_cast<double>(tree->store().floats());
      }
      mean.numbers /= nodes;
      mean.spheres /= nodes;
      mean.bytes = sizeof(float) * floats / nodes;
      return mean;
    };
    return trees;
  };
  all.push_back({name, serves_distance, build});
}

/// Returns spheres with their own radii, or with one that all but S0 share.
VolumeSize sizeOf(const kIOSd& bv, bool shared_radius) {
  const int k = bv.k();
  const bool shares = shared_radius && k > 1;
  return {shares ? 4.0 + 3 * (k - 1) + 1 : 4.0 * k, static_cast<double>(k)};
}

void addKios(Entrants& all, const std::string& name, const FitOptions& options) {
  const bool shared = options.shared_radius;
  add(all, name, KiosPolicy(options), [shared](const kIOSd& bv) { return sizeOf(bv, shared); });
}

/// Volumes that hold no more floats than their kind needs: for each cap its place, of so many
/// floats, and its radius.
template <typename Policy>
void addPacked(Entrants& all, const std::string& name, const Policy& policy, int floats_of_place) {
  const auto size_of = [floats_of_place](const PackedStore::Packed& bv) {
    int caps = 0;
    for (int axis = 0; axis < 8; ++axis) caps += 2 * ((bv.pairs >> axis) & 1);
    return VolumeSize{4.0 + (floats_of_place + 1) * caps, 1.0 + caps};
  };
  add(all, name, policy, size_of);
}

/// The paper's kinds (III-A) and its scale of k (V-B).
void addKinds(Entrants& all) {
  FitOptions every;
  every.count = SphereCount::kAll;
  addPacked(all, "kios_packed_tuned", OrientedKios<5>(), 3);
  addPacked(all, "kios_k3", OrientedKios<3>(every), 3);
  addPacked(all, "kios_k7", OrientedKios<7>(every), 3);
  addPacked(all, "kios_axis_aligned", AxisAlignedKios(), 1);
  addPacked(all, "kios_fixed_axes", FixedDirectionKios(), 1);
  // Through the corners of an icosahedron: k = 13.
  const double g = (1 + std::sqrt(5.0)) / 2;
  const std::vector<fcl::Vector3d> six = {{0, 1, g},  {0, 1, -g}, {1, g, 0},
                                          {1, -g, 0}, {g, 0, 1},  {-g, 0, 1}};
  addPacked(all, "kios_fixed_6", FixedDirectionKios(six, every), 1);
}

template <typename Policy>
void addOther(Entrants& all, const std::string& name, double numbers, bool serves_distance = true) {
  const auto size_of = [numbers](const auto& /*bv*/) { return VolumeSize{numbers, 0}; };
  add(all, name, Policy(), size_of, serves_distance);
}

}  // namespace

std::vector<FitEntrant> fitEntrants() {
  Entrants all;
  addKios(all, "kios_method_i", FitMethod::kMethodI);
  addKios(all, "kios_method_i_at_angle", FitMethod::kMethodIAtAngle);
  addKios(all, "kios_method_ii", FitMethod::kMethodII);
  FitOptions shared(FitMethod::kMethodII), every_ii(FitMethod::kMethodII), every;
  shared.shared_radius = true;
  addKios(all, "kios_method_ii_shared", shared);
  every_ii.count = every.count = SphereCount::kAll;
  addKios(all, "kios_method_ii_k5", every_ii);
  addKios(all, "kios_tuned", FitMethod::kTuned);
  addKios(all, "kios_tuned_k5", every);
  // Angles about the paper's pi/6.
  for (const auto& [name, angle] : {std::pair("kios_tuned_15deg", kPi / 12),
                                    {"kios_tuned_22deg", kPi / 8},
                                    {"kios_tuned_45deg", kPi / 4}}) {
    FitOptions options;
    options.angle = angle;
    addKios(all, name, options);
  }
  addKinds(all);
  // In the paper's words: centre and radius, two corners, axes and half extents, ...
  addOther<SpherePolicy>(all, "sphere", 4);
  addOther<AabbPolicy>(all, "fcl_aabb", 6);
  addOther<OrientedPolicy<fcl::OBBd>>(all, "fcl_obb", 15, false);
  addOther<OrientedPolicy<fcl::RSSd>>(all, "fcl_rss", 15);
  addOther<OrientedPolicy<fcl::OBBRSSd>>(all, "fcl_obbrss", 30);
  addOther<KdopPolicy<24>>(all, "fcl_kdop24", 24);
  return all;
}

}  // namespace kios::bench
