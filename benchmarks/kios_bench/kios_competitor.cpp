// SPDX-FileCopyrightText: 2026 The fcl_kios authors
// SPDX-License-Identifier: BSD-3-Clause

#include <fcl_kios/fcl_kios.h>

#include "mesh_set.h"

namespace kios::bench {
namespace {

// The calls bind to the overloads that fcl_kios.h adds to namespace fcl.
struct KiosTraits {
  using BV = kios::kIOSd;
  using DistanceNode = kios::MeshDistanceTraversalNode<double>;
  using CollisionNode = kios::MeshCollisionTraversalNode<double>;
  static constexpr const char* kName = "kios";

  static void distance(const fcl::CollisionObjectd* a, const fcl::CollisionObjectd* b,
                       const fcl::DistanceRequestd& request, fcl::DistanceResultd& result) {
    fcl::distance(a, b, request, result);
  }
  static void collide(const fcl::CollisionObjectd* a, const fcl::CollisionObjectd* b,
                      const fcl::CollisionRequestd& request, fcl::CollisionResultd& result) {
    fcl::collide(a, b, request, result);
  }
  static std::optional<std::string> simdTarget() { return std::nullopt; }
};

}  // namespace

std::unique_ptr<Competitor> makeKiosCompetitor() { return std::make_unique<MeshSet<KiosTraits>>(); }

}  // namespace kios::bench
