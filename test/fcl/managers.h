// SPDX-FileCopyrightText: 2026 The fcl_kios authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <functional>
#include <map>
#include <memory>
#include <string>
#include <vector>

#include <fcl/broadphase/broadphase_SSaP.h>
#include <fcl/broadphase/broadphase_SaP.h>
#include <fcl/broadphase/broadphase_bruteforce.h>
#include <fcl/broadphase/broadphase_dynamic_AABB_tree.h>
#include <fcl/broadphase/broadphase_dynamic_AABB_tree_array.h>
#include <fcl/broadphase/broadphase_interval_tree.h>
#include <fcl/broadphase/broadphase_spatialhash.h>

// Every broadphase manager of FCL.

namespace kios::testing {

using Manager = std::shared_ptr<fcl::BroadPhaseCollisionManagerd>;
using Objects = std::vector<fcl::CollisionObjectd*>;

inline const std::map<std::string, std::function<Manager()>>& managers() {
  static const std::map<std::string, std::function<Manager()>> kManagers{
      {"Naive", [] { return std::make_shared<fcl::NaiveCollisionManagerd>(); }},
      {"SSaP", [] { return std::make_shared<fcl::SSaPCollisionManagerd>(); }},
      {"SaP", [] { return std::make_shared<fcl::SaPCollisionManagerd>(); }},
      {"IntervalTree", [] { return std::make_shared<fcl::IntervalTreeCollisionManagerd>(); }},
      {"DynamicAABBTree", [] { return std::make_shared<fcl::DynamicAABBTreeCollisionManagerd>(); }},
      {"DynamicAABBTree_Array",
       [] { return std::make_shared<fcl::DynamicAABBTreeCollisionManager_Arrayd>(); }},
      {"SpatialHashing", [] {
         return std::make_shared<fcl::SpatialHashingCollisionManager<double>>(
             0.5, fcl::Vector3d::Constant(-100), fcl::Vector3d::Constant(100));
       }}};
  return kManagers;
}

inline Manager filled(const std::function<Manager()>& make, const Objects& objects) {
  Manager manager = make();
  manager->registerObjects(objects);
  manager->setup();
  return manager;
}

}  // namespace kios::testing
