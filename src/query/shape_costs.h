// SPDX-FileCopyrightText: 2026 The fcl_kios authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <fcl/narrowphase/collision_request.h>
#include <fcl/narrowphase/collision_result.h>
#include "fcl_kios/model/model.h"

namespace kios {

/// FCL's approximate cost of a model and a shape: a source where the boxes in the world of the root
/// volume's box and of the shape overlap, if the former touches the shape. FCL tells that, unless a
/// triangle is known to touch, as the root's box is around it.
template <typename S>
void addApproximateCost(const Model<S>& model, const fcl::Transform3<S>& X_WM,
                        const fcl::CollisionGeometry<S>& shape, const fcl::Transform3<S>& X_WS,
                        bool triangle_touches, const fcl::CollisionRequest<S>& request,
                        fcl::CollisionResult<S>& result);

}  // namespace kios
