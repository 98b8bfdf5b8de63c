// SPDX-FileCopyrightText: 2026 The fcl_kios authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <vector>

#include "fcl_kios/model.h"

namespace kios::inspect {

/// Holds a model's tree of volumes together with what each node contains. Refers to the model.
class VolumeTree {
 public:
  /// The model must be finished.
  explicit VolumeTree(const Modeld& model);

  const Modeld& model() const { return *model_; }
  const kIOSd& volume(int node) const { return model_->getBV(node).bv; }
  bool isLeaf(int node) const { return model_->getBV(node).isLeaf(); }
  int depth() const { return depth_; }  ///< the deepest leaf's level; the root's is 0

  /// Returns the next level, of a level's nodes, in the order of their content: those at that level
  /// and the leaves above it, which together contain the model. {0} is the root's.
  std::vector<int> deeper(const std::vector<int>& nodes) const;

  /// Returns triangles in an order in which each node's are contiguous, and the node's part of it.
  const std::vector<int>& triangles() const { return triangles_; }
  int first(int node) const { return first_[node]; }
  int last(int node) const { return first_[node] + count_[node]; }

 private:
  const Modeld* model_;
  std::vector<int> triangles_;
  std::vector<int> first_, count_;
  int depth_ = 0;
};

}  // namespace kios::inspect
