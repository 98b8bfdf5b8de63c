// SPDX-FileCopyrightText: 2026 The fcl_kios authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <algorithm>
#include <cstddef>
#include <limits>
#include <memory>
#include <utility>

#include "fcl_kios/model/model.h"

namespace kios {

/// A model, and its members that FCL keeps private. `vertices` has room for num_vertices_allocated,
/// and so has `prev_vertices`, if there is one; `nodes` for num_nodes_allocated, and `primitives`
/// for as many as that tree has leaves. A tree has no nodes until it is whole, and none as soon as
/// geometry was added.
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
};

// In the body of a member of fcl::BVHModel.
#define KIOS_MEMBERS(S)                                                                       \
  kios::Members<S> {                                                                          \
    *this, num_tris_allocated, num_vertices_allocated, num_bvs_allocated, num_vertex_updated, \
        primitive_indices, bvs, num_bvs                                                       \
  }

template <typename T>
std::unique_ptr<T[]> makeArray(int n) {
  return std::unique_ptr<T[]>(new T[static_cast<std::size_t>(n)]);
}

template <typename T>
std::unique_ptr<T[]> copyOf(const T* array, int n, int room) {
  if (!array) return nullptr;
  auto copy = makeArray<T>(room);
  std::copy_n(array, n, copy.get());
  return copy;
}
template <typename T>
std::unique_ptr<T[]> copyOf(const T* array, int n) {
  return copyOf(array, n, n);
}

template <typename T>
void replace(T*& array, std::unique_ptr<T[]> by) {
  delete[] array;
  array = by.release();
}

/// Says so as FCL does, and returns its code.
int outOfMemory(const char* call);

}  // namespace kios
