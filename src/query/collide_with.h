// SPDX-FileCopyrightText: 2026 The fcl_kios authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <iostream>
#include <vector>

#include <fcl/geometry/shape/box.h>
#include <fcl/narrowphase/collision_request.h>
#include <fcl/narrowphase/collision_result.h>
#include "fcl_kios/fcl_own.h"
#include "fcl_kios/model/model.h"
#include "model/kios_model.h"

namespace kios {

/// FCL's approximate cost: that of the root volume's box against the shape, by FCL.
template <typename S>
void addApproximateCost(const Model<S>& model, const fcl::Transform3<S>& X_WM,
                        const fcl::CollisionGeometry<S>& other, const fcl::Transform3<S>& X_WO,
                        const fcl::CollisionRequest<S>& request, fcl::CollisionResult<S>& result) {
  fcl::Box<S> box;
  fcl::Transform3<S> X_WBox = fcl::Transform3<S>::Identity();
  constructBox(model.getBV(0).bv, X_WM, box, X_WBox);
  box.cost_density = model.cost_density;
  box.threshold_occupied = model.threshold_occupied;
  box.threshold_free = model.threshold_free;
  fcl::CollisionResult<S> only_costs;
  const fcl::CollisionGeometry<S>* root = &box;
  const fcl::CollisionRequest<S> costs(1, false, request.num_max_cost_sources, true, false);
  fcl_own::collide(root, X_WBox, &other, X_WO, costs, only_costs);
  std::vector<fcl::CostSource<S>> sources;
  only_costs.getCostSources(sources);
  for (const auto& source : sources) result.addCostSource(source, request.num_max_cost_sources);
}

/// The part that collisions of a model with shapes and with octrees share. search(request) adds
/// contacts, and cost sources if that request wants them; false if there was nothing to do.
template <typename S, class Other, class Search>
std::size_t collideWith(const Model<S>& model, const fcl::Transform3<S>& X_WM, const Other& other,
                        const fcl::Transform3<S>& X_WO, const fcl::CollisionRequest<S>& request,
                        fcl::CollisionResult<S>& result, const Search& search) {
  requireFinished(model);
  if (request.num_max_contacts == 0) {  // FCL's warning and answer
    std::cerr << "Warning: should stop early as num_max_contact is 0 !\n";
    return 0;
  }
  fcl::CollisionRequest<S> asked = request;
  const bool approximate = request.enable_cost && request.use_approximate_cost;
  if (approximate) asked.enable_cost = false;
  if (search(asked) && approximate) addApproximateCost(model, X_WM, other, X_WO, request, result);
  return result.numContacts();
}

}  // namespace kios
