// SPDX-FileCopyrightText: 2026 The fcl_kios authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <memory>

#include "fcl_kios/model.h"

namespace kios::scene {

/// Returns a part's mesh: the geometry itself, if it is one over k-IOS, or the faces of a box or
/// convex shape, as a solid. Throws std::invalid_argument for others, and says what to do.
std::shared_ptr<const Modeld> meshOfPart(
    const std::shared_ptr<const fcl::CollisionGeometryd>& geometry);

}  // namespace kios::scene
