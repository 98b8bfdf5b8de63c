// SPDX-FileCopyrightText: 2026 The fcl_kios authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <fcl/narrowphase/collision_request.h>
#include <fcl/narrowphase/collision_result.h>
#include <cstddef>
#include <iostream>
#include "fcl_kios/model/model.h"
#include "model/kios_model.h"

namespace kios {

/// Adds FCL's approximate cost sources of a model and a shape or an octree: those that FCL finds
/// for the box of the root volume in the model's place.
template <typename S>
void addApproximateCosts(const Model<S>& model, const fcl::Transform3<S>& X_WM,
                         const fcl::CollisionGeometry<S>& other, const fcl::Transform3<S>& X_WO,
                         const fcl::CollisionRequest<S>& request, fcl::CollisionResult<S>& result);

/// The part that collisions of a model with shapes and with octrees share. search(request) adds
/// contacts, and cost sources if that request wants them; false if there was nothing to do.
template <typename S, class Search>
std::size_t collideWith(const Model<S>& model, const fcl::Transform3<S>& X_WM,
                        const fcl::CollisionGeometry<S>& other, const fcl::Transform3<S>& X_WO,
                        const fcl::CollisionRequest<S>& request, fcl::CollisionResult<S>& result,
                        const Search& search) {
  requireFinished(model);
  if (request.num_max_contacts == 0) {  // FCL's warning and answer
    std::cerr << "Warning: should stop early as num_max_contact is 0 !\n";
    return 0;
  }
  fcl::CollisionRequest<S> asked = request;
  const bool costs = request.enable_cost && request.use_approximate_cost;
  if (costs) asked.enable_cost = false;
  if (search(asked) && costs) addApproximateCosts(model, X_WM, other, X_WO, request, result);
  return result.numContacts();
}

}  // namespace kios
