// SPDX-FileCopyrightText: 2026 The fcl_kios authors
// SPDX-License-Identifier: BSD-3-Clause
//
// Defines fcl::collide and fcl::distance itself, as a program to which FCL is linked statically,
// and calls them.
#include <fcl/narrowphase/collision_object.h>
#include <fcl/narrowphase/collision_request.h>
#include <fcl/narrowphase/collision_result.h>

std::size_t
collide(const fcl::CollisionGeometryd*, const fcl::Transform3d&, const fcl::CollisionGeometryd*, const fcl::Transform3d&, const fcl::CollisionRequestd&, fcl::CollisionResultd&) __asm__(
    "_ZN3fcl7collideIdEEmPKNS_17CollisionGeometryIT_EERKN5Eigen9TransformIS2_Li3ELi1ELi0EEES5_"
    "SA_RKNS_16CollisionRequestIS2_EERNS_15CollisionResultIS2_EE");
std::size_t collide(const fcl::CollisionGeometryd*, const fcl::Transform3d&,
                    const fcl::CollisionGeometryd*, const fcl::Transform3d&,
                    const fcl::CollisionRequestd&, fcl::CollisionResultd&) {
  return 42;
}

int main() {
  fcl::CollisionResultd result;
  const auto pose = fcl::Transform3d::Identity();
  return collide(nullptr, pose, nullptr, pose, fcl::CollisionRequestd(), result) == 42 ? 0 : 1;
}
