// SPDX-FileCopyrightText: 2026 The fcl_kios authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <Eigen/Core>
#include <array>

#include "build/mesh_view.h"
#include "tree/tree.h"
#include "volume/rounding.h"

namespace kios::engine {

/// The corners of a triangle relative to the tree's origin.
using FaceCorners = std::array<Eigen::Vector3d, 3>;

/// Sets a tree's origin to the middle of the box around the vertices that triangles use.
template <typename S>
void placeOrigin(const MeshView<S>& mesh, Tree& tree) {
  const auto [low, high] = mesh.box();
  Eigen::Map<Eigen::Vector3d>(tree.origin) = 0.5 * (low + high);
}

/// Writes all that depends on where a leaf's vertices and faces are: its lanes in the tree, its
/// centroid and its slab.
void placeLeaf(const Eigen::Vector3f* vertices, const FaceCorners* faces, Leaf& leaf, Tree& tree);

/// Does so for a leaf that knows its features, and writes its vertices.
template <typename S>
void placeLeaf(const MeshView<S>& mesh, Leaf& leaf, Tree& tree, Eigen::Vector3f* vertices) {
  const Eigen::Vector3d origin(tree.origin);
  FaceCorners faces[kLeafTriangles];
  for (int i = 0; i < leaf.num_faces; ++i) {
    const std::uint32_t t = tree.features[leaf.feature_offset + i].triangle();
    for (int k = 0; k < 3; ++k) {
      faces[i][k] = mesh.corner(t, k).template cast<double>() - origin;
      vertices[leaf.corners[3 * i + k]] = roundedTo<float>(faces[i][k]);
    }
  }
  placeLeaf(vertices, faces, leaf, tree);
}

/// Returns a vertex of a leaf as its lanes hold it.
inline Eigen::Vector3f vertexOf(const Tree& tree, const Leaf& leaf, int i) {
  const Lanes* const rows = &tree.lanes[leaf.offset + static_cast<std::size_t>(3 * (i / kLanes))];
  const int lane = i % kLanes;
  return {rows[0].v[lane], rows[1].v[lane], rows[2].v[lane]};
}

}  // namespace kios::engine
