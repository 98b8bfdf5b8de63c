// SPDX-FileCopyrightText: 2026 The fcl_kios authors
// SPDX-License-Identifier: BSD-3-Clause
//
// Queries of solids raise no floating-point flags.
#include "floating_point_flags.h"
#include "scalars.h"
#include "solid/solid_meshes.h"

namespace kios::testing {
namespace {

KIOS_SCALAR_SUITE(SolidTraps);

TYPED_TEST(SolidTraps, ContainmentAndPenetration) {
  using S = TypeParam;
  Flags flags;
  const auto meshes = solidMeshes();
  for (std::size_t i = 0; i < meshes.size(); ++i) {
    const auto& [name_a, mesh_a] = meshes[i];
    const auto& [name_b, mesh_b] = meshes[(i + 1) % meshes.size()];
    const std::string names = name_a + ", " + name_b + ": ";
    std::shared_ptr<Model<S>> a, b;
    flags.during(names + "inspectClosedness, markSolid", [&] {
      a = solidOf<S>(mesh_a);
      b = solidOf<S>(mesh_b);
    });
    Random random(i);
    const fcl::Transform3<S> here = fcl::Transform3<S>::Identity();
    for (int k = 0; k < 40; ++k) {
      fcl::Vector3<S> p = (3 * inCube(random)).template cast<S>();
      if (k == 0) p.setZero();
      if (k % 4 == 1) p = MeshIn<S>(mesh_a).vertices[k % mesh_a.vertices.size()];
      flags.during(names + "contains", [&] { contains<S>(*a, here, p); });
    }
    auto poses = scenes::randomPoses(6, 1.5, i);
    poses.push_back(at(0, 0, 0));
    poses.push_back(at(0.5, 0, 0));
    poses.push_back(at(1, 0, 0));
    for (const fcl::Transform3d& pose : poses) {
      const fcl::Transform3<S> X = pose.cast<S>();
      flags.during(names + "penetration", [&] { penetration<S>(*a, here, *b, X); });
      flags.during(names + "fcl::collide", [&] {
        fcl::CollisionResult<S> result;
        fcl::collide(a.get(), here, b.get(), X, fcl::CollisionRequest<S>(1, false), result);
      });
      flags.during(names + "fcl::distance", [&] {
        fcl::DistanceResult<S> result;
        fcl::distance(a.get(), here, b.get(), X, fcl::DistanceRequest<S>(true, true), result);
      });
    }
  }
}

}  // namespace
}  // namespace kios::testing
