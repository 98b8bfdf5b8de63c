// SPDX-FileCopyrightText: 2026 The fcl_kios authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <algorithm>
#include <cstddef>
#include <limits>
#include <memory>
#include <utility>

#include "fcl_kios/model.h"
#include "model/prepared.h"
#include "volume/large_arrays.h"

namespace kios {

/// A model, and its members that FCL keeps private. `vertices` has room for num_vertices_allocated,
/// and so has `prev_vertices`, if there is one. `nodes` and `primitives` are those of a Prepared,
/// at all times. A tree has no nodes until it is whole, and none as soon as geometry was added.
template <typename S>
struct Members {
  Model<S>& model;
  int &num_tris_allocated, &num_vertices_allocated, &num_nodes_allocated, &num_vertices_given;
  unsigned int*& primitives;
  fcl::BVNode<kIOS<S>>*& nodes;
  int& num_nodes;

  int numPrimitives() const { return model.num_tris > 0 ? model.num_tris : model.num_vertices; }
  /// Counts the nodes of a tree over all primitives; 0 if there are none, or more than FCL's nodes
  /// can count.
  int numNodes() const {
    const int n = numPrimitives();
    return n > 0 && n <= std::numeric_limits<int>::max() / 2 ? 2 * n - 1 : 0;
  }

  Prepared& prepared() const { return *Prepared::before<S>(nodes); }
  /// Takes it in the place of what was held.
  void take(PreparedHandle made) const {
    const PreparedHandle last(&prepared(), /*add_ref=*/false);
    nodes = made->template nodes<S>();
    primitives = made->template primitives<S>();
    num_nodes = num_nodes_allocated = made.detach()->num_nodes;
  }
  /// Makes it the model's own, to be changed.
  void own() const {
    PreparedHandle held(&prepared(), /*add_ref=*/false);
    kios::own<S>(held);
    nodes = held->template nodes<S>();
    primitives = held.detach()->template primitives<S>();
  }
};

template <typename S>
Members<S> membersOf(Model<S>& model) {
  return fcl::MakeParentRelativeRecurseImpl<S, kIOS<S>>::membersOf(model);
}

template <typename T>
std::unique_ptr<T[]> makeArray(int n) {
  std::unique_ptr<T[]> array(new T[static_cast<std::size_t>(n)]);
  preferHugePages(array.get(), static_cast<std::size_t>(n) * sizeof(T));
  return array;
}

template <typename T>
std::unique_ptr<T[]> copyOf(const T* array, int n, int room = 0) {
  if (!array) return nullptr;
  auto copy = makeArray<T>(std::max(n, room));
  std::copy_n(array, n, copy.get());
  return copy;
}

template <typename T>
void replace(T*& array, std::unique_ptr<T[]> by) {
  delete[] array;
  array = by.release();
}

/// Throws std::invalid_argument for the first triangle that refers to a vertex that isn't there.
void requireIndices(const fcl::Triangle* triangles, std::size_t n, std::size_t num_vertices);

/// Says so as FCL does, and returns its code.
int outOfMemory(const char* call);

}  // namespace kios

template <typename S>
kios::Members<S> fcl::MakeParentRelativeRecurseImpl<S, kios::kIOS<S>>::membersOf(
    BVHModel<kios::kIOS<S>>& m) {
  return {m,
          m.num_tris_allocated,
          m.num_vertices_allocated,
          m.num_bvs_allocated,
          m.num_vertex_updated,
          m.primitive_indices,
          m.bvs,
          m.num_bvs};
}
