// SPDX-FileCopyrightText: 2026 The fcl_kios authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <memory>

#include "build/mesh_tree.h"
#include "build/mesh_view.h"
#include "tree/tree.h"

namespace kios::engine {

/// Lengths of a mesh, and of a scene, for which floats keep clear of under- and overflow in every
/// kernel: squares of lengths and of 2^-24 of them, never their products.
constexpr double kLeastReach = 0x1p-36, kLargestReach = 0x1p40;

/// Builds the tree: weld, collapse the mesh's binary tree, assign the features, measure the
/// volumes. The mesh must have finite vertices, its extent within the lengths above. `volumes` are
/// the 2 n - 1 nodes that buildVolumes() gives for this mesh, of which only the places of spheres
/// are read: radii are measured anew. The tree depends on nothing but the mesh.
template <typename S>
std::unique_ptr<Tree> prepare(const MeshView<S>& mesh, const VolumeNode<S>* volumes);

/// Prepares a mesh of any size and place, or whose binary tree isn't ours: makes one for the time
/// being.
template <typename S>
std::unique_ptr<Tree> prepare(const MeshView<S>& mesh);

}  // namespace kios::engine
