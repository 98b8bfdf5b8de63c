// SPDX-FileCopyrightText: 2026 The fcl_kios authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstddef>
#include <iostream>

#include <fcl/narrowphase/collision_request.h>
#include <fcl/narrowphase/collision_result.h>
#include "fcl_kios/model/model.h"
#include "model/kios_model.h"

namespace kios {

/// The part that collisions of a model with shapes and with octrees share. search(request) adds
/// contacts, and cost sources if that request wants them; false if there was nothing to do. Those
/// that are only approximate are approximate(whether a triangle touches)'s.
template <typename S, class Search, class Approximate>
std::size_t collideWith(const Model<S>& model, const fcl::CollisionRequest<S>& request,
                        fcl::CollisionResult<S>& result, const Search& search,
                        const Approximate& approximate) {
  requireFinished(model);
  if (request.num_max_contacts == 0) {  // FCL's warning and answer
    std::cerr << "Warning: should stop early as num_max_contact is 0 !\n";
    return 0;
  }
  fcl::CollisionRequest<S> asked = request;
  const bool costs = request.enable_cost && request.use_approximate_cost;
  if (costs) asked.enable_cost = false;
  const std::size_t before = result.numContacts();
  if (search(asked) && costs) approximate(result.numContacts() > before);
  return result.numContacts();
}

}  // namespace kios
