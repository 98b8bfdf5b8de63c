// SPDX-FileCopyrightText: 2026 The fcl_kios authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <Eigen/Core>
#include <array>
#include <cstdint>
#include <vector>

#include "tree/tree.h"

namespace kios::engine {

/// The corners of a triangle relative to the tree's origin.
using FaceCorners = std::array<Eigen::Vector3d, 3>;

/// A triangle of a leaf.
struct LeafTriangle {
  std::uint32_t id;
  std::uint8_t vertices[3];  ///< its corners among the leaf's vertices
};

/// An edge of a leaf, its ends among the leaf's vertices.
struct LeafEdge {
  FeatureId id;
  std::uint8_t start, end;
};

/// The content of a leaf before it is written into lanes.
struct LeafContent {
  std::vector<LeafTriangle> triangles;
  std::vector<LeafEdge> edges;
  std::vector<FeatureId> owned;           ///< ids of the first of `vertices`
  std::vector<Eigen::Vector3f> vertices;  ///< distinct corners of the triangles
  std::vector<FaceCorners> faces;         ///< by triangle
};

/// Appends a leaf to the tree.
void appendLeaf(const LeafContent& content, Tree& tree);

/// Writes all that depends on where a leaf's vertices and faces are: its lanes in the tree, its
/// centroid and its slab.
void placeLeaf(const Eigen::Vector3f* vertices, const FaceCorners* faces, Leaf& leaf, Tree& tree);

}  // namespace kios::engine
