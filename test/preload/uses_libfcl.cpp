// SPDX-FileCopyrightText: 2026 The fcl_kios authors
// SPDX-License-Identifier: BSD-3-Clause
//
// A plug-in that asks libfcl.
#include "fcl_meshes.h"

extern "C" int ask() {
  const auto model = build<fcl::OBBRSSd>(torus(12, 8));
  std::mt19937 random(1);
  const fcl::CollisionGeometryd* const geometry = model.get();
  for (int i = 0; i < 200; ++i) {
    fcl::DistanceResultd distance;
    fcl::distance(geometry, fcl::Transform3d::Identity(), geometry, randomPose(random, 3, 4),
                  fcl::DistanceRequestd(), distance);
    if (!(distance.min_distance > 0 && distance.min_distance < 4)) return 1;
    fcl::CollisionResultd contacts;
    if (fcl::collide(geometry, fcl::Transform3d::Identity(), geometry, fcl::Transform3d::Identity(),
                     fcl::CollisionRequestd(), contacts) != 1) {
      return 2;
    }
  }
  return 0;
}
