// SPDX-FileCopyrightText: 2026 The fcl_kios authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "build/mesh_view.h"
#include "tree/tree.h"

namespace kios::engine {

/// Moves a tree to where the vertices of its mesh are now: topology and features stay, volumes and
/// leaves are fitted anew, in a small part of the time of prepare(). Returns false, and leaves the
/// tree unusable, if the mesh isn't the tree's any more (corners that were one vertex came apart,
/// other triangles), or if its partition has become poor. Vertices as prepare() needs them.
template <typename S>
bool refit(const MeshView<S>& mesh, Tree& tree);

}  // namespace kios::engine
