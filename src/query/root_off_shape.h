// SPDX-FileCopyrightText: 2026 The fcl_kios authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "fcl_kios/model/model.h"
#include "model/kios_model.h"

namespace kios {

/// True only if a finished model is farther than `margin` >= 0 from one of FCL's nine shapes, told
/// by the central sphere of its root, or by its root's box if it is prepared, along the axis of
/// either that faces the other. Roundings of the poses are paid for; nothing else of the pair need
/// be looked at. False says nothing: solidOffBox() tries all axes of both. `squared_errors` is
/// squaredRotationErrors(X_WS, X_WM), and lengths are in the unit of the coordinates. Throws
/// std::invalid_argument if a size of the shape is none; a convex shape with such a vertex, or
/// without any, gives false.
template <typename S>
bool rootOffShape(const Model<S>& model, const fcl::Transform3<S>& X_WM,
                  const fcl::CollisionGeometry<S>& shape, const fcl::Transform3<S>& X_WS,
                  double squared_errors, double margin);

}  // namespace kios
