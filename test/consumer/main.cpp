// SPDX-FileCopyrightText: 2026 The fcl_kios authors
// SPDX-License-Identifier: BSD-3-Clause
//
// Two unit cubes, the second turned by 45 degrees about z: an edge faces a face. Asked of the
// installed package in every way that a planner would ask, by this file and by generic.cpp.
#include <fcl_kios/fcl_kios.h>

#include <cmath>
#include <iostream>
#include <memory>

#include "generic.h"

namespace {

using Model = fcl::BVHModel<kios::kIOSd>;

int failures = 0;

void check(const char* what, bool right) {
  std::cout << (right ? "ok      " : "FAILED  ") << what << '\n';
  failures += right ? 0 : 1;
}

std::shared_ptr<Model> cube() {
  const int corners[12][3] = {{0, 2, 1}, {1, 2, 3}, {4, 5, 6}, {5, 7, 6}, {0, 1, 4}, {1, 5, 4},
                              {2, 6, 3}, {3, 6, 7}, {0, 4, 2}, {2, 4, 6}, {1, 3, 5}, {3, 7, 5}};
  auto corner = [](int i) {
    return fcl::Vector3d((i & 1) - 0.5, ((i >> 1) & 1) - 0.5, ((i >> 2) & 1) - 0.5);
  };
  auto model = std::make_shared<Model>();
  model->beginModel();
  for (const auto& t : corners) model->addTriangle(corner(t[0]), corner(t[1]), corner(t[2]));
  model->endModel();
  return model;
}

void ask(fcl::CollisionObjectd& a, fcl::CollisionObjectd& b, double expected) {
  const bool touching = expected == 0;
  auto is_expected = [expected](double d) { return std::abs(d - expected) <= 1e-14; };
  std::cout << "expected distance " << expected << '\n';

  fcl::CollisionResultd collision;
  fcl::collide(&a, &b, fcl::CollisionRequestd(), collision);
  check("fcl::collide", collision.isCollision() == touching);

  fcl::DistanceResultd clearance;
  fcl::distance(&a, &b, fcl::DistanceRequestd(), clearance);
  check("fcl::distance", is_expected(clearance.min_distance));

  fcl::CollisionObjectd far_away(cube(), fcl::Matrix3d::Identity(), {50, 0, 0});
  fcl::DynamicAABBTreeCollisionManagerd manager;
  for (auto* object : {&a, &b, &far_away}) manager.registerObject(object);
  manager.setup();

  fcl::DefaultCollisionData<double> collision_data;
  manager.collide(&collision_data, fcl::DefaultCollisionFunction<double>);
  check("DefaultCollisionFunction", collision_data.result.isCollision() == touching);

  fcl::DefaultDistanceData<double> distance_data;
  manager.distance(&distance_data, fcl::DefaultDistanceFunction<double>);
  check("DefaultDistanceFunction", is_expected(distance_data.result.min_distance));

  check("generic.cpp, collide", generic::collides(a, b) == touching);
  check("generic.cpp, distance", is_expected(generic::distance(a, b)));
  check("generic.cpp, DefaultCollisionFunction", generic::collides(manager) == touching);
  check("generic.cpp, DefaultDistanceFunction", is_expected(generic::distance(manager)));
}

}  // namespace

int main() {
  const double half_diagonal = std::sqrt(0.5);
  const fcl::Matrix3d turned =
      fcl::AngleAxisd(std::atan(1.0), fcl::Vector3d::UnitZ()).toRotationMatrix();
  fcl::CollisionObjectd a(cube(), fcl::Matrix3d::Identity(), {0, 0, 0});
  fcl::CollisionObjectd b(cube(), turned, {3, 0, 0});
  ask(a, b, 2.5 - half_diagonal);

  b.setTranslation({1, 0, 0});
  b.computeAABB();
  ask(a, b, 0);

  std::cout << "fcl_kios " << FCL_KIOS_VERSION_STRING << ": "
            << (failures == 0 ? "all right" : "FAILED") << '\n';
  return failures == 0 ? 0 : 1;
}
