// SPDX-FileCopyrightText: 2026 The fcl_kios authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <memory>
#include <string>

#include <fcl/fcl.h>
#include "preload/transcript.h"

// Queries of FCL whose answers go into a transcript.

inline Transcript* transcript = nullptr;

/// Asks fcl::distance in both forms by turns.
inline void askDistance(const std::string& name, const std::shared_ptr<fcl::CollisionGeometryd>& a,
                        const fcl::Transform3d& X_WA,
                        const std::shared_ptr<fcl::CollisionGeometryd>& b,
                        const fcl::Transform3d& X_WB, const fcl::DistanceRequestd& request,
                        double bound = 0, double tolerance = 1e-12) {
  fcl::DistanceResultd result;
  if (bound > 0) result.min_distance = bound;
  static int turn = 0;
  double returned;
  if (++turn % 2 == 0) {
    returned = fcl::distance(a.get(), X_WA, b.get(), X_WB, request, result);
  } else {
    const fcl::CollisionObjectd object_a(a, X_WA), object_b(b, X_WB);
    returned = fcl::distance(&object_a, &object_b, request, result);
  }
  transcript->add(name + "_returned", returned, tolerance);
  transcript->add(name, result.min_distance, tolerance);
  const auto which = [&](const fcl::CollisionGeometryd* o) {
    return o == a.get() ? 1 : o == b.get() ? 2 : o ? 3 : 0;
  };
  transcript->add(name + "_o1", which(result.o1));
  transcript->add(name + "_o2", which(result.o2));
  // An octree's id is the difference of two addresses.
  const bool octree = a->getNodeType() == fcl::GEOM_OCTREE || b->getNodeType() == fcl::GEOM_OCTREE;
  transcript->add(name + "_ids", (!octree && result.b1 >= 0 ? 1 : 0) + (result.b2 >= 0 ? 2 : 0));
  // FCL's points for a sphere are in no frame.
  const bool sphere = a->getNodeType() == fcl::GEOM_SPHERE || b->getNodeType() == fcl::GEOM_SPHERE;
  if (request.enable_nearest_points && result.o1 && result.min_distance > 0 && !sphere) {
    transcript->add(name + "_points", (result.nearest_points[0] - result.nearest_points[1]).norm(),
                    10 * tolerance);
  }
}

/// Asks fcl::collide.
inline void askCollide(const std::string& name, const std::shared_ptr<fcl::CollisionGeometryd>& a,
                       const fcl::Transform3d& X_WA,
                       const std::shared_ptr<fcl::CollisionGeometryd>& b,
                       const fcl::Transform3d& X_WB, const fcl::CollisionRequestd& request) {
  fcl::CollisionResultd result;
  static int turn = 0;
  std::size_t returned;
  if (++turn % 2 == 0) {
    returned = fcl::collide(a.get(), X_WA, b.get(), X_WB, request, result);
  } else {
    const fcl::CollisionObjectd object_a(a, X_WA), object_b(b, X_WB);
    returned = fcl::collide(&object_a, &object_b, request, result);
  }
  transcript->add(name + "_returned", static_cast<double>(returned));
  transcript->add(name, static_cast<double>(result.numContacts()));
  transcript->add(name + "_costs", static_cast<double>(result.numCostSources()));
  const bool copies = a->getNodeType() == fcl::BV_RSS;  // FCL's contacts name its copies
  for (std::size_t i = 0; i < result.numContacts(); ++i) {
    const auto& contact = result.getContact(i);
    if (!copies) {
      transcript->add(name + "_o1", contact.o1 == a.get() ? 1 : contact.o1 == b.get() ? 2 : 3);
      transcript->add(name + "_o2", contact.o2 == a.get() ? 1 : contact.o2 == b.get() ? 2 : 3);
    }
    const bool octree = !copies && contact.o1->getNodeType() == fcl::GEOM_OCTREE;
    if (!octree) transcript->add(name + "_has_b1", contact.b1 >= 0);
    transcript->add(name + "_has_b2", contact.b2 >= 0);
    if (!request.enable_contact) continue;
    // Contacts are FCL's own, to the bit.
    if (!octree) transcript->add(name + "_b1", static_cast<double>(contact.b1));
    transcript->add(name + "_b2", static_cast<double>(contact.b2));
    transcript->add(name + "_depth", contact.penetration_depth);
    for (int c = 0; c < 3; ++c) {
      transcript->add(name + "_position", contact.pos[c]);
      transcript->add(name + "_normal", contact.normal[c]);
    }
  }
}
