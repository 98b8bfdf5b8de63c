// SPDX-FileCopyrightText: 2026 The fcl_kios authors
// SPDX-License-Identifier: BSD-3-Clause

#include <memory>

#include "fcl_kios/fcl/mesh_nodes.h"
#include "node_queries.h"

namespace kios::bench {
namespace {

template <FitMethod kMethod>
struct TreeTraits
    : NodeQueries<MeshDistanceTraversalNode<double>, MeshCollisionTraversalNode<double>> {
  using BV = kIOSd;
  static constexpr const char* kName =
      kMethod == FitMethod::kMethodII ? "kios_method_ii" : "kios_tree";

  static std::shared_ptr<fcl::detail::BVFitterBase<BV>> fitter() {
    return std::make_shared<fcl::detail::BVFitter<BV>>(kMethod);
  }
};

}  // namespace

std::unique_ptr<Competitor> makeKiosTreeCompetitor() {
  return std::make_unique<MeshSet<TreeTraits<FitMethod::kTuned>>>();
}

std::unique_ptr<Competitor> makeMethodTwoCompetitor() {
  return std::make_unique<MeshSet<TreeTraits<FitMethod::kMethodII>>>();
}

}  // namespace kios::bench
