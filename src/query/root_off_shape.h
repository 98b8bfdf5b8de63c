// SPDX-FileCopyrightText: 2026 The fcl_kios authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "fcl_kios/model/model.h"
#include "model/kios_model.h"

namespace kios {

/// True only if the central sphere of a finished model's root proves it farther than `margin` >= 0
/// from one of FCL's nine shapes, the rounding of poses included: nothing else of the pair need be
/// looked at; or the box of its tree does, if that is prepared. `squared_errors` is
/// squaredRotationErrors(X_WS, X_WM). False says nothing. Throws std::invalid_argument if the shape
/// has a size that is none; a convex shape with such a vertex gives false.
template <typename S>
bool rootOffShape(const Model<S>& model, const fcl::Transform3<S>& X_WM,
                  const fcl::CollisionGeometry<S>& shape, const fcl::Transform3<S>& X_WS,
                  double squared_errors, double margin);

}  // namespace kios
