// SPDX-FileCopyrightText: 2026 The fcl_kios authors
// SPDX-License-Identifier: BSD-3-Clause

// Prints every bit of the answers of queries, a line a query. Whatever the machine, and whatever
// instruction set the environment variable FCL_KIOS_SIMD chooses, the output must be the same:
// same_targets.sh compares. The name of the target goes to the standard error stream.

#include <cinttypes>
#include <cstdio>
#include <cstring>
#include <memory>
#include <stdexcept>
#include <vector>

#include "fcl_kios/detail/rigid.h"
#include "fcl_kios/fcl_kios.h"
#include "scenes/shape_geometry.h"
#include "search/prepared_pair.h"

namespace kios::testing {
namespace {

template <typename S>
void print(const fcl::Vector3<S>& p) {
  for (int i = 0; i < 3; ++i) std::printf(" %a", double{p[i]});
}

/// Distances and contacts. Those to shapes are computed by Eigen's products, which it fuses on ARM:
/// the last bits differ, and so may ties. They, and depths, which FCL's build for a machine
/// decides, stand in lines of their own.
template <typename S>
void ask(const fcl::CollisionGeometry<S>& a, const fcl::Transform3<S>& X_A,
         const fcl::CollisionGeometry<S>& b, const fcl::Transform3<S>& X_B) {
  const bool meshes = b.getObjectType() == fcl::OT_BVH;
  for (const S rel_err : {S(0), S(0.1)}) {
    fcl::DistanceResult<S> result;
    const S d =
        fcl::distance(&a, X_A, &b, X_B, fcl::DistanceRequest<S>(true, false, rel_err), result);
    std::printf("%s %a %" PRIdPTR, meshes ? "" : "points", double{d}, result.b1);
    if (meshes) std::printf(" %" PRIdPTR, result.b2);
    for (const fcl::Vector3<S>& p : result.nearest_points) print<S>(p);
    std::printf("\n");
  }
  for (const std::size_t most : {1, 4, 100000}) {
    fcl::CollisionResult<S> result;
    fcl::collide(&a, X_A, &b, X_B, fcl::CollisionRequest<S>(most, true), result);
    std::vector<fcl::Contact<S>> contacts;
    result.getContacts(contacts);
    std::printf("%zu", contacts.size());
    for (const auto& contact : contacts) {
      std::printf(" %" PRIdPTR " %" PRIdPTR, contact.b1, meshes ? contact.b2 : 0);
    }
    std::printf("\n%s", meshes ? "depths" : "points");
    for (const auto& contact : contacts) {
      if (meshes) std::printf(" %a", double{contact.penetration_depth});
      if (!meshes) print<S>(contact.pos);
    }
    std::printf("\n");
  }
}

/// Rays at vertices, along edges and anywhere, from around a mesh.
template <typename S>
void cast(const Model<S>& model, const fcl::Transform3<S>& X, std::uint64_t seed) {
  Random random(seed);
  for (int i = 0; i < 24; ++i) {
    const auto t = static_cast<int>(random.unit() * model.num_tris);
    const fcl::Triangle& ids = model.tri_indices[t];
    Ray<S> ray;
    for (S& c : ray.origin) c = static_cast<S>(random.uniform(-3, 3));
    ray.direction = detail::transform<S>(X, model.vertices[ids[0]]) - ray.origin;
    if (i % 3 == 1) {
      ray.direction =
          detail::rotate<S>(X.linear(), model.vertices[ids[1]] - model.vertices[ids[0]]);
    }
    if (ray.direction.isZero(0)) ray.direction = -ray.origin;
    for (const std::size_t most : {1, 100000}) {
      for (const RayHit<S>& hit : allHits(model, X, ray, most)) {
        std::printf("%d %a", hit.triangle, double{hit.t});
        print<S>(hit.point);
        print<S>(hit.weights);
      }
      std::printf("\n");
    }
  }
}

/// Returns FCL's shapes, of sizes about those of the mesh, and a floor.
template <typename S>
std::vector<std::shared_ptr<fcl::CollisionGeometry<S>>> shapes() {
  const fcl::Vector3<S> n(S(0.6), 0, S(0.8));
  return {std::make_shared<fcl::Box<S>>(S(0.5), S(0.75), S(0.25)),
          std::make_shared<fcl::Box<S>>(S(100), S(100), S(0.5)),
          std::make_shared<fcl::Sphere<S>>(S(0.5)),
          std::make_shared<fcl::Ellipsoid<S>>(S(0.5), S(0.25), S(0.75)),
          std::make_shared<fcl::Capsule<S>>(S(0.25), S(0.5)),
          std::make_shared<fcl::Cone<S>>(S(0.5), S(0.75)),
          std::make_shared<fcl::Cylinder<S>>(S(0.5), S(0.25)),
          scenes::convexOf<S>(rounded(scenes::icosphere(0.6, 0), 0x1p-20)),
          std::make_shared<fcl::Halfspace<S>>(n, S(-0.5)),
          std::make_shared<fcl::Plane<S>>(n, S(0.5))};
}

template <typename S>
void askAll() {
  constexpr double kGrid = 0x1p-30;
  const auto b = scenes::buildModel<kIOS<S>>(rounded(scenes::bumpyTorus(400), kGrid));
  for (const NamedMesh& named : unitMeshes()) {
    const auto a = scenes::buildModel<kIOS<S>>(rounded(named.mesh, kGrid));
    std::printf("%s\n", named.name.c_str());
    Random random(5);
    for (std::uint64_t i = 0; i < 6; ++i) {
      const auto X1 = wholePose(random, 1.5).template cast<S>();
      const auto X2 = wholePose(random, 1.5).template cast<S>();
      ask<S>(*a, X1, *b, X2);
      ask<S>(*b, X1, *a, X2);
      cast<S>(*a, X1, i);
      if (i >= 3) continue;
      for (const auto& shape : shapes<S>()) ask<S>(*a, X1, *shape, X2);
    }
  }
  // Ties, at a pose that rounds nothing.
  const auto sheet = scenes::buildModel<kIOS<S>>(lattice(12, 1));
  for (int i = 0; i < 6; ++i) {
    fcl::Transform3<S> X = fcl::Transform3<S>::Identity();
    X.translation() = fcl::Vector3<S>(S(3 * i), S(0.5), S(i / 2));
    ask<S>(*sheet, fcl::Transform3<S>::Identity(), *sheet, X);
  }
}

}  // namespace
}  // namespace kios::testing

int main() {
  try {
    std::fprintf(stderr, "%s\n", kios::simdTarget());
    kios::testing::askAll<double>();
    kios::testing::askAll<float>();
  } catch (const std::invalid_argument& error) {
    std::fprintf(stderr, "%s\n", error.what());
    return 2;
  }
}
