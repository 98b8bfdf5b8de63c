// SPDX-FileCopyrightText: 2026 The fcl_kios authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <memory>

#include "build/mesh_view.h"
#include "fcl_kios/model/model.h"
#include "tree/tree_cache.h"

namespace kios {

/// The cache of a model and its copies; nullptr if its fitter is not ours.
template <typename S>
engine::TreeCache* treesOf(const Model<S>& model);

/// The model's prepared tree, made if need be; empty if it has none: its fitter is not ours, or its
/// size is beyond the range of floats. The model must be finished.
template <typename S>
engine::TreeCache::Use preparedTree(const Model<S>& model);

/// Copies the root of the tree that was prepared last of the model and its copies; false if that is
/// not the model's, or there is none.
template <typename S>
bool copyRoot(const Model<S>& model, engine::TreeRoot& root);

/// The tree that prepare() makes of the mesh of a model whose tree of volumes is the ordinary one;
/// preparedTree() may have refitted that of an earlier state. The model is prepared then, too.
template <typename S>
engine::SharedTree purelyPreparedTree(const Model<S>& model);

/// Gives a finished model the tree that prepare() would make of its mesh, unless others hold one
/// of equal content, which then is taken.
template <typename S>
void takePrepared(const Model<S>& model, std::unique_ptr<engine::Tree> tree);

template <typename S>
engine::MeshView<S> viewOf(const Model<S>& model) {
  return {model.vertices, static_cast<std::size_t>(model.num_vertices), model.tri_indices,
          static_cast<std::size_t>(model.num_tris)};
}

/// Returns the state of a model, as its root volume and arrays tell it.
template <typename S>
engine::TreeKey keyOf(const Model<S>& model) {
  const engine::MeshView<S> mesh = viewOf(model);
  return {model.getBV(0).bv.stamp, mesh.vertices, mesh.triangles, mesh.num_vertices,
          mesh.num_triangles};
}

}  // namespace kios
