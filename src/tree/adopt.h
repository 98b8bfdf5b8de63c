// SPDX-FileCopyrightText: 2026 The fcl_kios authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "build/mesh_view.h"
#include "tree/tree.h"

namespace kios::engine {

/// Completes a tree that comes from elsewhere: its blocks, depth and hash of indices follow from
/// the rest, which is as prepare() made it of this mesh. Returns false, and leaves the tree
/// unusable, if its arrays contradict each other or the mesh. Of others, whatever their floats are,
/// no search and no refit reads beyond an array, or has no end; but they answer wrongly if spheres
/// or lanes aren't those of the mesh. Floats are taken as they are: to fit them anew, as refit()
/// does, takes three times as long as loading all of a model. Linear in time. Raises no
/// floating-point exception.
template <typename S>
bool adopt(const MeshView<S>& mesh, Tree& tree);

}  // namespace kios::engine
