// SPDX-FileCopyrightText: 2026 The fcl_kios authors
// SPDX-License-Identifier: BSD-3-Clause
//
// A plug-in that asks libfcl.
#include "preload/fcl_meshes.h"

namespace {

/// Builds, refits from the leaves, whose volumes are wrong, and from the root, ends: all that fits.
template <typename BV>
bool fits() {
  const Soup soup = torus(12, 8);
  const auto model = build<BV>(soup);
  const BV& root = model->getBV(0).bv;
  const double size = root.size();
  for (const bool bottom_up : {true, false}) {
    model->beginReplaceModel();
    model->replaceSubModel(soup.vertices);
    if (model->endReplaceModel(true, bottom_up) != fcl::BVH_OK) return false;
  }
  return size > 1 && std::abs(root.size() - size) < 1e-9;
}

}  // namespace

extern "C" int ask() {
  if (!fits<fcl::OBBd>() || !fits<fcl::RSSd>() || !fits<fcl::kIOSd>() || !fits<fcl::OBBRSSd>()) {
    return 3;
  }
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
