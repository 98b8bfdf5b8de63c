// SPDX-FileCopyrightText: 2026 The fcl_kios authors
// SPDX-License-Identifier: BSD-3-Clause
#include "tree/box_fit.h"

#include <Eigen/Geometry>
#include <algorithm>

#include "tree/leaf_layout.h"
#include "tree/node_layout.h"
#include "volume/rounding.h"

namespace kios::engine {
namespace {

/// What the box of a node is chosen by.
struct Content {
  Eigen::Vector3f low, high;     ///< along the model's axes
  Eigen::Vector3f edge, normal;  ///< of the largest triangle, the edge its longest
  float area = -1;               ///< of that triangle: a norm of its normal

  void add(const Content& o) {
    low = low.cwiseMin(o.low);
    high = high.cwiseMax(o.high);
    if (!(o.area > area)) return;
    edge = o.edge;
    normal = o.normal;
    area = o.area;
  }
};

Content contentOf(const Leaf& leaf, const Tree& tree) {
  Eigen::Vector3f vertices[kMaxLeafFeatures];
  Content content;
  for (int i = 0; i < leaf.num_vertices; ++i) {
    vertices[i] = vertexOf(tree, leaf, i);
    content.low = i == 0 ? vertices[i] : content.low.cwiseMin(vertices[i]);
    content.high = i == 0 ? vertices[i] : content.high.cwiseMax(vertices[i]);
  }
  for (int i = 0; i < leaf.num_faces; ++i) {
    const std::uint8_t* const corners = leaf.corners + 3 * i;
    const Eigen::Vector3f &p = vertices[corners[0]], &q = vertices[corners[1]],
                          &r = vertices[corners[2]];
    const Eigen::Vector3f pq = q - p, pr = r - p, normal = pq.cross(pr);
    const float area = normal.lpNorm<1>();  // squares may be too large
    if (!(area > content.area)) continue;
    const Eigen::Vector3f qr = r - q;
    const float square_pq = pq.squaredNorm(), square_pr = pr.squaredNorm();
    content.area = area;
    content.normal = normal;
    content.edge = square_pq > square_pr ? pq : pr;
    if (qr.squaredNorm() > std::max(square_pq, square_pr)) content.edge = qr;
  }
  return content;
}

/// Coordinates are floats: what is computed of them in double is rounded once, to the half.
Box alongModel(const Content& content) {
  Box box = {};
  float* const rows[3] = {box.x, box.y, box.z};
  for (int c = 0; c < 3; ++c) {
    const double low = content.low[c], high = content.high[c];
    const auto middle = static_cast<float>(0.5 * (low + high));
    rows[c][c] = 1;
    rows[c][kCenter] = middle;
    box.half[c] = roundUpFloat(std::max(high - middle, middle - low) * (1 + 4 * kUlpDouble));
  }
  return box;
}

double surface(const Box& box) {
  const double x = box.half[0], y = box.half[1], z = box.half[2];
  return x * y + y * z + z * x;
}

}  // namespace

// Nodes lie before their children.
TreePoints::TreePoints(const Tree& tree) : ranges_(tree.nodes.size()) {
  chunks_.reserve(2 * tree.leaves.size());
  std::vector<Range> of_leaf(tree.leaves.size());
  for (std::size_t l = 0; l < tree.leaves.size(); ++l) {
    const Leaf& leaf = tree.leaves[l];
    of_leaf[l].begin = chunks_.size();
    for (int i = 0; i < leaf.num_vertices; i += kLanes) {
      const Lanes* const rows = &tree.lanes[leaf.offset + 3 * (i / kLanes)];
      chunks_.push_back({rows[0], rows[1], rows[2]});
    }
    of_leaf[l].end = chunks_.size();
  }
  for (std::size_t n = tree.nodes.size(); n-- > 0;) {
    const Node& node = tree.nodes[n];
    if (node.isLeaf()) {
      ranges_[n] = of_leaf[node.leaf()];
      continue;
    }
    ranges_[n] = ranges_[node.first_child];
    for (int i = 1; i < tree.children[static_cast<std::size_t>(node.child)].count; ++i) {
      const Range& of_child = ranges_[node.first_child + i];
      ranges_[n].begin = std::min(ranges_[n].begin, of_child.begin);
      ranges_[n].end = std::max(ranges_[n].end, of_child.end);
    }
  }
}

bool fitBoxes(const TreePoints& points, Tree& tree) {
  std::vector<Content> contents(tree.nodes.size());
  bool any_flat = false;
  for (std::size_t n = tree.nodes.size(); n-- > 0;) {  // children lie behind their parents
    Node& node = tree.nodes[n];
    Content& content = contents[n];
    if (node.isLeaf()) {
      content = contentOf(tree.leaves[node.leaf()], tree);
    } else {
      const int count = tree.children[static_cast<std::size_t>(node.child)].count;
      content = contents[node.first_child];
      for (int i = 1; i < count; ++i) content.add(contents[node.first_child + i]);
    }
    Box& best = tree.boxes[n];
    const auto consider = [&](const Box& box) {
      if (surface(box) < surface(best)) best = box;
    };
    consider(alongModel(content));
    consider(boxAround(axesAlong(content.edge, content.normal), points.chunksOf(n),
                       points.numChunks(n)));
    node.flat = isFlat(best);
    any_flat |= node.flat != 0;
  }
  writeBoxBlocks(tree);
  return any_flat;
}

}  // namespace kios::engine
