// SPDX-FileCopyrightText: 2026 The fcl_kios authors
// SPDX-License-Identifier: BSD-3-Clause

#include "aabb_tree.h"

#include <algorithm>
#include <numeric>

namespace kios::scenes {
namespace {

ExactBox boxOf(const ExactTriangle& triangle) {
  return {triangle[0].cwiseMin(triangle[1]).cwiseMin(triangle[2]),
          triangle[0].cwiseMax(triangle[1]).cwiseMax(triangle[2])};
}

ExactBox join(const ExactBox& a, const ExactBox& b) {
  return {a.lower.cwiseMin(b.lower), a.upper.cwiseMax(b.upper)};
}

}  // namespace

long double boxDistance(const ExactBox& a, const ExactBox& b) {
  const ExactPoint gap = (a.lower - b.upper).cwiseMax(b.lower - a.upper);
  return gap.cwiseMax(ExactPoint::Zero()).norm();
}

AabbTree::AabbTree(const std::vector<ExactTriangle>& triangles) {
  // Three times the centroid of each triangle.
  std::vector<ExactPoint> centroids;
  centroids.reserve(triangles.size());
  for (const ExactTriangle& t : triangles) centroids.emplace_back(t[0] + t[1] + t[2]);
  std::vector<int> order(triangles.size());
  std::iota(order.begin(), order.end(), 0);

  struct Range {
    int node;
    std::size_t begin;
    std::size_t end;
  };
  nodes_.reserve(2 * triangles.size() - 1);
  nodes_.emplace_back();
  std::vector<Range> pending{{0, 0, triangles.size()}};
  while (!pending.empty()) {
    const Range range = pending.back();
    pending.pop_back();
    if (range.end - range.begin == 1) {
      nodes_[range.node].triangle = order[range.begin];
      continue;
    }
    ExactBox span{centroids[order[range.begin]], centroids[order[range.begin]]};
    for (std::size_t i = range.begin; i < range.end; ++i) {
      span = join(span, {centroids[order[i]], centroids[order[i]]});
    }
    int axis = 0;
    (span.upper - span.lower).maxCoeff(&axis);
    const std::size_t middle = range.begin + (range.end - range.begin) / 2;
    std::nth_element(order.begin() + range.begin, order.begin() + middle, order.begin() + range.end,
                     [&](int i, int j) { return centroids[i][axis] < centroids[j][axis]; });
    const int left = static_cast<int>(nodes_.size());
    nodes_[range.node].left = left;
    nodes_.resize(nodes_.size() + 2);
    pending.push_back({left, range.begin, middle});
    pending.push_back({left + 1, middle, range.end});
  }
}

std::vector<ExactBox> AabbTree::boxes(const std::vector<ExactTriangle>& triangles) const {
  std::vector<ExactBox> boxes(nodes_.size());
  for (std::size_t i = nodes_.size(); i-- > 0;) {
    const Node& node = nodes_[i];
    boxes[i] = node.triangle >= 0 ? boxOf(triangles[node.triangle])
                                  : join(boxes[node.left], boxes[node.left + 1]);
  }
  return boxes;
}

}  // namespace kios::scenes
