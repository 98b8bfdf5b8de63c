// SPDX-FileCopyrightText: 2026 The fcl_kios authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <functional>
#include <memory>
#include <string>
#include <vector>

#include "paper/variant_tree.h"

namespace kios::bench {

using Split = std::shared_ptr<const paper::MeshSplit>;

/// Two nodes of the splits of both meshes at a pose, and the distance of their triangles.
struct NodePair {
  int a, b;
  RelativePose<double> X_AB;
  double distance;
};

/// Holds means over the nodes of both trees: numbers that describe a volume, as the paper counts;
/// bytes that it takes here; its spheres, 0 if it has none.
struct FitSize {
  double numbers = 0, bytes = 0, spheres = 0;
};

/// A volume over the splits of two meshes. All share splits, traversal and leaf tests, so that they
/// differ by their volumes alone.
struct FitTrees {
  std::function<paper::VariantResult(const RelativePose<double>&X_AB)> distance, collide;
  /// Returns the bound of two nodes, for a distance query.
  std::function<double(const NodePair& pair)> bound;
  std::function<FitSize()> size;
};

/// Holds a volume and its fit.
struct FitEntrant {
  std::string name;
  bool serves_distance;  ///< false for a volume without distances
  std::function<FitTrees(const Split& a, const Split& b)> build;
};

/// Returns all constructions of k-IOS, and the volumes that they are compared with.
std::vector<FitEntrant> fitEntrants();

}  // namespace kios::bench
