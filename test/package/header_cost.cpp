// SPDX-FileCopyrightText: 2026 The fcl_kios authors
// SPDX-License-Identifier: BSD-3-Clause

// A user's file, over k-IOS or, without KIOS, over one of FCL's volumes. header_cost.sh measures
// how long either compiles: with USE what calls cost, without it the header alone.
#ifdef KIOS
#include <fcl_kios/fcl_kios.h>
using Volume = kios::kIOSd;
#else
#include <fcl/fcl.h>
using Volume = fcl::OBBRSSd;
#endif

#ifdef USE
double nearest(const std::vector<fcl::Vector3d>& vertices,
               const std::vector<fcl::Triangle>& triangles) {
  const auto mesh = std::make_shared<fcl::BVHModel<Volume>>();
  mesh->beginModel();
  mesh->addSubModel(vertices, triangles);
  mesh->endModel();
  fcl::CollisionObjectd a(mesh), b(mesh, fcl::Transform3d(fcl::Translation3d(2, 0, 0)));
  fcl::DistanceResultd distance;
  fcl::distance(&a, &b, fcl::DistanceRequestd(true), distance);
  fcl::CollisionResultd collision;
  fcl::collide(&a, &b, fcl::CollisionRequestd(), collision);

  fcl::DynamicAABBTreeCollisionManagerd manager;
  manager.registerObject(&a);
  manager.registerObject(&b);
  manager.setup();
  fcl::DefaultDistanceData<double> data;
  manager.distance(&data, fcl::DefaultDistanceFunction<double>);
  return collision.isCollision() ? 0 : distance.min_distance + data.result.min_distance;
}
#endif
