// SPDX-FileCopyrightText: 2026 The fcl_kios authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "build/mesh.h"
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

template <typename S>
engine::MeshView<S> viewOf(const Model<S>& model) {
  return {model.vertices, static_cast<std::size_t>(model.num_vertices), model.tri_indices,
          static_cast<std::size_t>(model.num_tris)};
}

}  // namespace kios
