// SPDX-FileCopyrightText: 2026 The fcl_kios authors
// SPDX-License-Identifier: BSD-3-Clause
#include "engine/box_fit.h"

#include <Eigen/Geometry>
#include <algorithm>

#include "engine/node_layout.h"
#include "volume/rounding.h"

namespace kios::engine {
namespace {

/// What the box of a node is chosen by.
struct Content {
  Eigen::Vector3f low, high;     ///< along the model's axes
  Eigen::Vector3f edge, normal;  ///< of the largest triangle, the edge its longest
  double squared_area = -1;      ///< of that triangle, four times

  void add(const Content& o) {
    low = low.cwiseMin(o.low);
    high = high.cwiseMax(o.high);
    if (!(o.squared_area > squared_area)) return;
    edge = o.edge;
    normal = o.normal;
    squared_area = o.squared_area;
  }
};

Content contentOf(const Leaf& leaf, const Tree& tree) {
  Content content;
  const auto vertex = [&](int i) {
    const Lanes* const rows = &tree.lanes[leaf.offset + static_cast<std::size_t>(3 * (i / kLanes))];
    return Eigen::Vector3f(rows[0].v[i % kLanes], rows[1].v[i % kLanes], rows[2].v[i % kLanes]);
  };
  content.low = content.high = vertex(0);
  for (int i = 1; i < leaf.num_vertices; ++i) {
    const Eigen::Vector3f p = vertex(i);
    content.low = content.low.cwiseMin(p);
    content.high = content.high.cwiseMax(p);
  }
  for (int i = 0; i < leaf.num_faces; ++i) {
    const Eigen::Vector3d p = vertex(leaf.corners[3 * i]).cast<double>();
    const Eigen::Vector3d q = vertex(leaf.corners[3 * i + 1]).cast<double>();
    const Eigen::Vector3d r = vertex(leaf.corners[3 * i + 2]).cast<double>();
    const Eigen::Vector3d normal = (q - p).cross(r - p);
    const double squared_area = normal.dot(normal);
    if (!(squared_area > content.squared_area)) continue;
    Eigen::Vector3d edge = q - p;
    if ((r - q).dot(r - q) > edge.dot(edge)) edge = r - q;
    if ((p - r).dot(p - r) > edge.dot(edge)) edge = p - r;
    content.squared_area = squared_area;
    content.edge = edge.cast<float>();
    content.normal = normal.cast<float>();
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

bool fitBoxes(const std::vector<PointChunk>& chunks, const std::vector<ChunkRange>& of_node,
              Tree& tree) {
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
    const ChunkRange range = of_node[n];
    consider(boxAround(axesAlong(content.edge, content.normal), &chunks[range.begin],
                       range.end - range.begin));
    node.flat = isFlat(best);
    any_flat |= node.flat != 0;
  }
  writeBoxBlocks(tree);
  return any_flat;
}

}  // namespace kios::engine
