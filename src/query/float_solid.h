// SPDX-FileCopyrightText: 2026 The fcl_kios authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "query/posed_solid.h"
#include "search/solid_search.h"

namespace kios {

/// The solid in the frame of the mesh's prepared tree. False if floats can't serve the pair:
/// lengths out of range, or a pad that is not small against the mesh. The walk of the tree of
/// volumes then does. `any_slab`: the pad is to cover slabs across anything, not only those across
/// triangles of the tree.
bool makeFloatSolid(const engine::Tree& tree, const PosedSolid& posed, bool any_slab,
                    engine::FloatSolid& out);

/// A slab {n x <= offset} of a bounded solid, n unit, in the tree's frame.
engine::FloatSlab slabInTree(const engine::Tree& tree, const PosedSolid& posed, const shape::Vec& n,
                             double offset);

}  // namespace kios
