// SPDX-FileCopyrightText: 2026 The fcl_kios authors
// SPDX-License-Identifier: BSD-3-Clause

#include <fcl_kios/fcl_kios.h>

#include "mesh_set.h"
#include "shape_competitor.h"

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

  static std::nullptr_t fitter() { return nullptr; }

  // Volumes tested and pairs of leaves (of up to eight triangles each) reached.
  static void countDistance(const kios::Modeld& a, const kios::Modeld& b,
                            const scenes::Frame& poses, fcl::DistanceResultd& result,
                            TestCounts& counts) {
    kios::SearchCounts search;
    kios::distanceMeshes(a, poses.X_WA, b, poses.X_WB, fcl::DistanceRequestd(), result, &search);
    add(search, counts);
  }
  static void countCollide(const kios::Modeld& a, const kios::Modeld& b, const scenes::Frame& poses,
                           fcl::CollisionResultd& result, TestCounts& counts) {
    kios::SearchCounts search;
    kios::collideMeshes(a, poses.X_WA, b, poses.X_WB, fcl::CollisionRequestd(), result, &search);
    add(search, counts);
  }
  static std::size_t preparedBytes(const kios::Modeld& model) { return kios::preparedBytes(model); }
  static std::optional<std::string> simdTarget() { return kios::simdTarget(); }

 private:
  static void add(const kios::SearchCounts& search, TestCounts& counts) {
    counts.bv_tests += search.volume_tests;
    counts.leaf_tests += search.leaf_pairs;
  }
};

}  // namespace

std::unique_ptr<ShapeCompetitor> makeKiosShapeCompetitor() {
  return std::make_unique<MeshAndShape<KiosTraits>>();
}

std::unique_ptr<Competitor> makeKiosCompetitor() { return std::make_unique<MeshSet<KiosTraits>>(); }

}  // namespace kios::bench
