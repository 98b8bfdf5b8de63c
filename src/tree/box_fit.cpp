// SPDX-FileCopyrightText: 2026 The fcl_kios authors
// SPDX-License-Identifier: BSD-3-Clause
#include "tree/box_fit.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>

#include "tree/leaf_layout.h"
#include "tree/node_layout.h"
#include "volume/large_arrays.h"
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
    const auto middle = roundedTo<float>(0.5 * (low + high));
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

/// Measures the halves anew, in double: the allowance for floats is more than gaps between bodies
/// that are put on each other. A height is off by 2^-50 of the box's extent at most.
void tighten(const PointChunk* chunks, std::size_t num_chunks, Box& box) {
  const double error = 0x1p-50 * (double{box.half[0]} + box.half[1] + box.half[2]);
  double most[3] = {};
  for (std::size_t i = 0; i < num_chunks; ++i) {
    for (int l = 0; l < kLanes; ++l) {
      const double x = double{chunks[i].x.v[l]} - box.x[kCenter];
      const double y = double{chunks[i].y.v[l]} - box.y[kCenter];
      const double z = double{chunks[i].z.v[l]} - box.z[kCenter];
      for (int k = 0; k < 3; ++k) {
        most[k] = std::max(most[k], std::abs(x * box.x[k] + y * box.y[k] + z * box.z[k]));
      }
    }
  }
  for (int k = 0; k < 3; ++k) box.half[k] = std::min(box.half[k], roundUpFloat(most[k] + error));
}

/// Takes one of the other boxes around a node's content where it has less surface than `best`.
void takeLeast(const Content& content, const PointChunk* chunks, std::size_t num_chunks,
               Box& best) {
  for (const Box& box : {alongModel(content),
                         boxAround(axesAlong(content.edge, content.normal), chunks, num_chunks)}) {
    if (surface(box) < surface(best)) best = box;
  }
}

}  // namespace

// Nodes lie before their children.
TreePoints::TreePoints(const Tree& tree) : ranges_(tree.nodes.size()) {
  reserveLarge(chunks_, 2 * tree.leaves.size());
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
    takeLeast(content, points.chunksOf(n), points.numChunks(n), tree.boxes[n]);
    node.flat = isFlat(tree.boxes[n]);
    any_flat |= node.flat != 0;
  }
  writeBoxBlocks(tree);
  return any_flat;
}

void fitRootBox(const TreePoints& points, Tree& tree) {
  const PointChunk* const chunks = points.chunksOf(0);
  const std::size_t num_chunks = points.numChunks(0);
  if (tree.boxes.empty()) {
    Content content = contentOf(tree.leaves[0], tree);
    for (const Leaf& leaf : tree.leaves) content.add(contentOf(leaf, tree));
    takeLeast(content, chunks, num_chunks, tree.root_box);
    tighten(chunks, num_chunks, tree.root_box);
  } else {
    tighten(chunks, num_chunks, tree.boxes[0]);
    tree.root_box = tree.boxes[0];
  }
}

Box triangleBox(const Tree& tree, const Leaf& leaf, std::uint32_t face) {
  Eigen::Vector3f corners[3];
  for (std::uint32_t k = 0; k < 3; ++k)
    corners[k] = vertexOf(tree, leaf, leaf.corners[3 * face + k]);
  PointChunk chunk;
  for (int l = 0; l < kLanes; ++l) {
    const Eigen::Vector3f& p = corners[std::min(l, 2)];
    chunk.x.v[l] = p[0];
    chunk.y.v[l] = p[1];
    chunk.z.v[l] = p[2];
  }
  const Eigen::Vector3f edge = corners[1] - corners[0];
  const Eigen::Vector3f normal = edge.cross(corners[2] - corners[0]);
  Box box = boxAround(axesAlong(normal, edge), &chunk, 1);
  tighten(&chunk, 1, box);
  return box;
}

}  // namespace kios::engine
