// SPDX-FileCopyrightText: 2026 The fcl_kios authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <vector>

#include "fcl/geometry/shape/box.h"
#include "fcl/narrowphase/collision_request.h"
#include "fcl/narrowphase/collision_result.h"
#include "fcl_kios/fcl/model.h"
#include "fcl_kios/overloads.h"

namespace kios {

/// FCL's approximate cost: that of the root volume's box against the shape, by FCL.
template <typename S>
void addApproximateCost(const Model<S>& model, const fcl::Transform3<S>& tf1,
                        const fcl::CollisionGeometry<S>& other, const fcl::Transform3<S>& tf2,
                        const fcl::CollisionRequest<S>& request, fcl::CollisionResult<S>& result) {
  fcl::Box<S> box;
  fcl::Transform3<S> box_tf = fcl::Transform3<S>::Identity();
  constructBox(model.getBV(0).bv, tf1, box, box_tf);
  box.cost_density = model.cost_density;
  box.threshold_occupied = model.threshold_occupied;
  box.threshold_free = model.threshold_free;
  fcl::CollisionResult<S> only_costs;
  const fcl::CollisionGeometry<S>* root = &box;
  fcl::collide(root, box_tf, &other, tf2,
               fcl::CollisionRequest<S>(1, false, request.num_max_cost_sources, true, false),
               only_costs);
  std::vector<fcl::CostSource<S>> sources;
  only_costs.getCostSources(sources);
  for (const auto& source : sources) result.addCostSource(source, request.num_max_cost_sources);
}

}  // namespace kios
