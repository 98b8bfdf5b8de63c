// SPDX-FileCopyrightText: 2026 The fcl_kios authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <fcl/geometry/bvh/BV_node.h>
#include "fcl_kios/volume/kios.h"
#include "model/members.h"
#include "tree/content_hash.h"

namespace kios {

// Meshes of equal content have equal volumes: a build copies those of a finished model that lives
// anywhere in the process. Any thread may call these.

/// Meshes of fewer triangles share nothing: they are built as soon as others would be found.
constexpr int kLeastShared = 4;
/// Copies of fewer share nothing: they are made as soon as listed, and built in some microseconds.
constexpr int kLeastSharedCopy = 64;

/// The arrays of a model's tree: 2 n - 1 nodes and n primitives.
template <typename S>
struct TreeArrays {
  fcl::BVNode<kIOS<S>>* nodes = nullptr;
  unsigned int* primitives = nullptr;
};

/// Copies the volumes shared for this content into `to`. False if there are none.
template <typename S>
bool copySharedVolumes(const engine::ContentHash& content, std::size_t n, const TreeArrays<S>& to);

/// Shares the volumes of a mesh of this content until releaseVolumes(). Where there is no memory,
/// nothing is shared.
void shareVolumes(const engine::ContentHash& content, const void* nodes, const void* primitives);

/// Shares a copy of volumes, if they are shared themselves.
void shareCopy(const void* nodes, const void* copied_nodes, const void* copied_primitives);

/// When this returns, nobody reads these nodes, nor the primitives that were shared with them. To
/// be called before they change or go; nodes that aren't shared do no harm.
void releaseVolumes(const void* nodes);
template <typename S>
void releaseVolumes(const Members<S>& m) {
  if (m.num_nodes_allocated >= 2 * kLeastShared - 1) releaseVolumes(m.nodes);  // else too few
}

}  // namespace kios
