// SPDX-FileCopyrightText: 2026 The fcl_kios authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "build/mesh_view.h"
#include "build/volume_fit.h"

namespace kios::engine {

/// Nodes on the way from the root to any leaf, at most.
constexpr int kMaxDepth = 64;

/// Partitions a mesh of n > 0 triangles and fits its volumes in one go: makes 2 n - 1 nodes in the
/// order of FCL's recursion, and `primitives` with the triangles in the order of the leaves.
/// O(n log n) for any mesh. Depends on nothing but the mesh. Returns false, and has written nothing
/// that counts, if a used vertex is not finite, or the mesh is beyond 2^500 (double) or 2^60
/// (float) in place or size, or below the inverse in size.
template <typename S>
bool buildVolumes(const MeshView<S>& mesh, VolumeNode<S>* nodes, unsigned int* primitives);

}  // namespace kios::engine
