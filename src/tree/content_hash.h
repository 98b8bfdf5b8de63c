// SPDX-FileCopyrightText: 2026 The fcl_kios authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstddef>

#include "build/mesh_view.h"
#include "tree/fingerprint.h"

namespace kios::engine {

/// Stands for a mesh's arrays, so that meshes of equal content find each other: their fingerprint
/// and their sizes. Nobody compares the arrays themselves, since those of a model are its owner's,
/// who may write them at any time.
struct ContentHash {
  Fingerprint arrays;
  std::size_t vertex_bytes = 0, triangle_bytes = 0, scalar_bytes = 0;

  bool operator==(const ContentHash& o) const {
    return arrays == o.arrays && vertex_bytes == o.vertex_bytes &&
           triangle_bytes == o.triangle_bytes && scalar_bytes == o.scalar_bytes;
  }
};

template <typename S>
ContentHash contentHash(const MeshView<S>& mesh) {
  static_assert(sizeof(fcl::Vector3<S>) == 3 * sizeof(S));
  const std::size_t vertex_bytes = mesh.num_vertices * sizeof(*mesh.vertices);
  const std::size_t triangle_bytes = mesh.num_triangles * sizeof(*mesh.triangles);
  return {fingerprint(mesh.vertices, vertex_bytes, mesh.triangles, triangle_bytes), vertex_bytes,
          triangle_bytes, sizeof(S)};
}

/// Hashes the triangles' indices alone.
template <typename S>
ContentHash indexHash(const MeshView<S>& mesh) {
  return contentHash(MeshView<S>{nullptr, 0, mesh.triangles, mesh.num_triangles});
}

/// For unordered containers.
struct HashOfContent {
  std::size_t operator()(const ContentHash& hash) const {
    return static_cast<std::size_t>(hash.arrays.first);
  }
};

}  // namespace kios::engine
