// SPDX-FileCopyrightText: 2026 The fcl_kios authors
// SPDX-License-Identifier: BSD-3-Clause
#include "volume_tree.h"

#include <algorithm>
#include <utility>

namespace kios::inspect {

VolumeTree::VolumeTree(const Modeld& model)
    : model_(&model), first_(model.getNumBVs()), count_(model.getNumBVs()) {
  triangles_.reserve(model.num_tris);
  // Depth first, with a stack of our own: FCL's trees may be as deep as they have triangles. A node
  // is met again, as ~node, when all below it has been listed.
  std::vector<std::pair<int, int>> waiting = {{0, 0}};
  while (!waiting.empty()) {
    const auto [node, level] = waiting.back();
    waiting.pop_back();
    if (node < 0) {
      count_[~node] = static_cast<int>(triangles_.size()) - first_[~node];
      continue;
    }
    first_[node] = static_cast<int>(triangles_.size());
    const auto& bv = model.getBV(node);
    if (bv.isLeaf()) {
      triangles_.push_back(bv.primitiveId());
      count_[node] = 1;
      depth_ = std::max(depth_, level);
    } else {
      waiting.emplace_back(~node, level);
      waiting.emplace_back(bv.rightChild(), level + 1);
      waiting.emplace_back(bv.leftChild(), level + 1);
    }
  }
}

std::vector<int> VolumeTree::deeper(const std::vector<int>& nodes) const {
  std::vector<int> next;
  next.reserve(2 * nodes.size());
  for (const int node : nodes) {
    const auto& bv = model_->getBV(node);
    if (bv.isLeaf()) {
      next.push_back(node);
    } else {
      next.push_back(bv.leftChild());
      next.push_back(bv.rightChild());
    }
  }
  return next;
}

}  // namespace kios::inspect
