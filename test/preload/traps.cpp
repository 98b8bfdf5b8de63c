// SPDX-FileCopyrightText: 2026 The fcl_kios authors
// SPDX-License-Identifier: BSD-3-Clause
//
// Knows FCL only, and traps invalid operations and divisions by zero: they end it.
#include <fenv.h>

#include <cstdio>

#include "preload/fcl_meshes.h"

namespace {

template <typename BV>
double ask(bool has_distance) {
  const auto a = build<BV>(torus(24, 16)), b = build<BV>(torus(20, 12));
  const fcl::Boxd box(0.4, 0.5, 0.6);
  const fcl::Sphered sphere(0.3);
  const fcl::CollisionGeometryd* const others[] = {b.get(), &box, &sphere};
  std::mt19937 random(1);
  double sum = 0;
  for (int i = 0; i < 150; ++i) {
    const fcl::Transform3d X = randomPose(random, 0, i % 3 == 0 ? 1.5 : 4);
    for (const fcl::CollisionGeometryd* const other : others) {
      fcl::CollisionResultd contacts;
      sum += static_cast<double>(fcl::collide<double>(a.get(), fcl::Transform3d::Identity(), other,
                                                      X, fcl::CollisionRequestd(), contacts));
      // FCL's own distances to shapes are trapped.
      if (!has_distance || contacts.isCollision() || other != b.get()) continue;
      fcl::DistanceResultd distance;
      sum += fcl::distance<double>(a.get(), fcl::Transform3d::Identity(), other, X,
                                   fcl::DistanceRequestd(true), distance);
    }
  }
  return sum;
}

}  // namespace

int main() {
  feenableexcept(FE_INVALID | FE_DIVBYZERO);
  const double sum = ask<fcl::OBBRSSd>(true) + ask<fcl::RSSd>(true) + ask<fcl::kIOSd>(true) +
                     ask<fcl::OBBd>(false);
  std::printf("%.6g\n", sum);
  return 0;
}
