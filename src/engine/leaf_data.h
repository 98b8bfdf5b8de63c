// SPDX-FileCopyrightText: 2026 The fcl_kios authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <Eigen/Core>
#include <cstdint>
#include <vector>

#include "engine/tree.h"

namespace kios::engine {

/// A triangle of a leaf: its id and its corners relative to the tree's origin.
struct LeafTriangle {
  std::uint32_t id;
  Eigen::Vector3d corners[3];
  std::uint8_t vertices[3];  ///< its corners among the leaf's vertices
};

/// An edge of a leaf, its ends among the leaf's vertices.
struct LeafEdge {
  FeatureId id;
  std::uint8_t start, end;
};

/// What a leaf holds, gathered.
struct LeafContent {
  std::vector<LeafTriangle> triangles;
  std::vector<LeafEdge> edges;
  std::vector<FeatureId> owned;           ///< ids of the first of `vertices`
  std::vector<Eigen::Vector3f> vertices;  ///< distinct corners of the triangles
};

/// Appends a leaf to the tree.
void appendLeaf(const LeafContent& content, Tree& tree);

}  // namespace kios::engine
