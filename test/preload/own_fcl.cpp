// SPDX-FileCopyrightText: 2026 The fcl_kios authors
// SPDX-License-Identifier: BSD-3-Clause
//
// A plug-in with an FCL of its own, of which it has what it needs: one of the four functions.
#include <fcl/narrowphase/collision_object.h>
#include <fcl/narrowphase/collision_request.h>
#include <fcl/narrowphase/collision_result.h>

std::size_t
collide(const fcl::CollisionGeometryd*, const fcl::Transform3d&, const fcl::CollisionGeometryd*, const fcl::Transform3d&, const fcl::CollisionRequestd*, fcl::CollisionResultd*) __asm__(
    "_ZN3fcl7collideIdEEmPKNS_17CollisionGeometryIT_EERKN5Eigen9TransformIS2_Li3ELi1ELi0EEES5_"
    "SA_RKNS_16CollisionRequestIS2_EERNS_15CollisionResultIS2_EE");
std::size_t collide(const fcl::CollisionGeometryd*, const fcl::Transform3d&,
                    const fcl::CollisionGeometryd*, const fcl::Transform3d&,
                    const fcl::CollisionRequestd*, fcl::CollisionResultd*) {
  return 42;
}

extern "C" int ask() {
  const auto pose = fcl::Transform3d::Identity();
  return collide(nullptr, pose, nullptr, pose, nullptr, nullptr) == 42 ? 0 : 1;
}
