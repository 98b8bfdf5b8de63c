// SPDX-FileCopyrightText: 2026 The fcl_kios authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <vector>

#include "query/posed_solid.h"
#include "search/solid_search.h"

namespace kios {

/// The solid in the frame of the mesh's prepared tree. False if floats can't serve the pair:
/// lengths out of range, or a pad that is not small against the mesh. The walk of the tree of
/// volumes then does. `planes` take those of a convex shape's faces, in the same frame, if the mesh
/// has so many triangles that they pay.
template <typename S>
bool makeFloatSolid(const engine::Tree& tree, const PosedSolid<S>& posed,
                    std::vector<engine::FloatSlab>& planes, engine::FloatSolid& out);

/// The slab of a bounded solid across n, unit and in its frame, in the tree's. Its bounds pay
/// FloatSolid::pad.
template <typename S>
engine::FloatSlab slabAcross(const engine::Tree& tree, const PosedSolid<S>& posed,
                             const shape::Vec& n);

}  // namespace kios
