// SPDX-FileCopyrightText: 2026 The fcl_kios authors
// SPDX-License-Identifier: BSD-3-Clause
#include "build/mesh_tree.h"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <limits>
#include <new>
#include <unordered_map>
#include <utility>
#include <vector>

#include "build/block_partition.h"
#include "build/tuning.h"
#include "volume/large_arrays.h"
#include "volume/rounding.h"

namespace kios::engine {
namespace {

using lanes::Float4;

using tuning::kBlock, tuning::kSample;

template <typename S>
class MeshTree {
 public:
  MeshTree(const MeshView<S>& mesh, VolumeNode<S>* nodes, unsigned int* primitives)
      : mesh_(mesh), nodes_(nodes), primitives_(primitives), fit_(mesh, nodes, primitives) {}

  bool run() {
    if (!setFrame()) return false;
    const int n = static_cast<int>(mesh_.num_triangles);
    new (nodes_) VolumeNode<S>;
    reserveLarge(centroids_, mesh_.num_triangles);
    centroids_.resize(mesh_.num_triangles);
    if (n > kBlock) reserveLarge(all_, mesh_.num_triangles / 2);
    for (int t = 0; t < n; ++t) {
      const auto triangle = static_cast<std::uint32_t>(t);
      const Corners corners = cornersOf(triangle, frame_);
      const Float4 sum = corners.v[0] + corners.v[1] + corners.v[2];
      centroids_[t] = {{sum[0], sum[1], sum[2]}, triangle};
    }
    divide(n);
    fitLarge();
    return true;
  }

 private:
  struct Centroid {
    float sum[3];  ///< of the corners
    std::uint32_t triangle;
  };
  struct Part {
    int node, first, count, depth;
  };

  /// The box around the used vertices, scaled to a length of about 1.
  bool setFrame() {
    fcl::Vector3<S> low = mesh_.corner(0, 0), high = low;
    S poison = 0;  // NaN if a coordinate is not finite
    corners_of_each_ = 1;
    for (std::size_t t = 0; t < mesh_.num_triangles; ++t) {
      const bool point =
          mesh_.index(t, 1) == mesh_.index(t, 0) && mesh_.index(t, 2) == mesh_.index(t, 0);
      if (!point) corners_of_each_ = 3;
      for (int k = 0; k < (point ? 1 : 3); ++k) {
        const fcl::Vector3<S>& p = mesh_.corner(t, k);
        poison += S(0) * p[0] + S(0) * p[1] + S(0) * p[2];
        low = low.cwiseMin(p);
        high = high.cwiseMax(p);
      }
    }
    if (poison != 0) return false;
    constexpr double kMost = sizeof(S) == sizeof(double) ? 0x1p500 : 0x1p60;
    double extent = 0;
    for (int c = 0; c < 3; ++c) {
      const double l = low[c], h = high[c];
      if (!(std::abs(l) < kMost && std::abs(h) < kMost)) return false;
      frame_.origin[c] = 0.5 * (l + h);
      extent = std::max(extent, h - l);
    }
    if (extent != 0 && extent < 1 / kMost) return false;
    frame_.setExponent(extent == 0 ? 0 : std::ilogb(extent));
    return true;
  }

  void setRange(const Part& part) {
    nodes_[part.node].first_primitive = part.first;
    nodes_[part.node].num_primitives = part.count;
  }

  /// Numbers the children as FCL does: in pairs, depth first, left before right.
  void branch(const Part& part, int left, SmallVector<Part>& stack) {
    const int child = num_nodes_;
    num_nodes_ += 2;
    nodes_[part.node].first_child = child;
    new (&nodes_[child]) VolumeNode<S>;
    new (&nodes_[child + 1]) VolumeNode<S>;
    stack.push_back({child + 1, part.first + left, part.count - left, part.depth + 1});
    stack.push_back({child, part.first, left, part.depth + 1});
  }

  /// True if all parts below must be halved for the tree to end within kMaxDepth: another split of
  /// a different kind may leave all but one triangle on one side.
  static bool mustHalve(const Part& part) {
    int levels = 0;
    while (part.count >> levels > 1) ++levels;
    return part.depth + levels + 2 >= kMaxDepth;
  }

  void divide(int n) {
    SmallVector<Part> stack = {{0, 0, n, 1}};
    while (!stack.empty()) {
      const Part part = stack.back();
      stack.pop_back();
      if (part.count <= kBlock) {
        addBlock(part);
        continue;
      }
      setRange(part);
      large_.push_back(part.node);
      branch(part, cutLarge(part), stack);
    }
  }

  Corners cornersOf(std::uint32_t triangle, const PointFrame& frame) const {
    Corners t;
    t.v[0] = frame.place(mesh_.corner(triangle, 0));
    for (int k = 1; k < 3; ++k) {
      t.v[k] = k < corners_of_each_ ? frame.place(mesh_.corner(triangle, k)) : t.v[0];
    }
    return t;
  }

  /// Orders the triangles of a part by a plane that a sample of them chooses. Returns how many lie
  /// left of it.
  int cutLarge(const Part& part) {
    const auto begin = centroids_.begin() + part.first, end = begin + part.count;
    corners_.resize(kSample);
    for (std::size_t i = 0; i < kSample; ++i) {
      const std::size_t at = i * static_cast<std::size_t>(part.count) / kSample;
      corners_[i] = cornersOf(begin[static_cast<std::ptrdiff_t>(at)].triangle, frame_);
    }
    LaneFrame axes;
    const CutPlane plane =
        partition_.cut(corners_.data(), kSample, roundedTo<float>(part.count) / kSample, axes);
    const int axis = std::max(plane.axis, 0);
    const float x = axes.columns[0][axis], y = axes.columns[1][axis], z = axes.columns[2][axis];
    const auto height = [=](const Centroid& c) {
      return c.sum[0] * x + c.sum[1] * y + c.sum[2] * z;
    };
    if (plane.axis >= 0 && !mustHalve(part)) {
      const auto middle =
          std::partition(begin, end, [&](const Centroid& c) { return height(c) < plane.value; });
      if (middle != begin && middle != end) return static_cast<int>(middle - begin);
    }
    const int left = part.count / 2;
    std::nth_element(begin, begin + left, end,
                     [&](const Centroid& a, const Centroid& b) { return height(a) < height(b); });
    return left;
  }

  /// Divides a part to its triangles, and fits all its nodes while it lies in the cache.
  void addBlock(const Part& root) {
    PointFrame frame = frame_;
    const fcl::Vector3<S>& origin = mesh_.corner(centroids_[root.first].triangle, 0);
    for (int c = 0; c < 3; ++c) frame.origin[c] = origin[c];
    corners_.resize(static_cast<std::size_t>(root.count));
    for (int i = 0; i < root.count; ++i) {
      corners_[i] = cornersOf(centroids_[root.first + i].triangle, frame);
    }
    partition_.start(corners_.data(), root.count);
    // Nodes of the block: the root, and those numbered from here on.
    const int below = num_nodes_;
    cluster_sizes_.assign(static_cast<std::size_t>(root.count), 0);
    if (root.count <= kLeafTriangles) cluster_sizes_[0] = root.count;
    stack_.push_back(root);
    while (!stack_.empty()) {
      const Part part = stack_.back();
      stack_.pop_back();
      setRange(part);
      if (part.count == 1) continue;
      const int first = part.first - root.first;
      const int left = partition_.split(first, part.count, mustHalve(part));
      const int right = part.count - left;
      branch(part, left, stack_);
      if (part.count <= kLeafTriangles) continue;
      if (left <= kLeafTriangles) cluster_sizes_[first] = left;
      if (right <= kLeafTriangles) cluster_sizes_[first + left] = right;
    }
    const float reach = gatherPoints(root);
    fit_.setFrame(frame, reach);
    extremes_.clear();
    extremes_of_.assign(static_cast<std::size_t>(num_nodes_ - below), -1);
    for (int node = num_nodes_; node-- > below;) {  // children before parents
      extremes_of_[node - below] = fitInBlock(node, root.first, below);
    }
    const int of_root = fitInBlock(root.node, root.first, below);
    fit_.finishSmall();
    if (!large_.empty()) keepBlock(root, frame, of_root);
  }

  /// Fills quads_ and chunks_ in the order of the leaves; returns the largest coordinate.
  float gatherPoints(const Part& root) {
    quads_.resize(static_cast<std::size_t>(root.count));
    Float4 most = {};
    for (int i = 0; i < root.count; ++i) {
      const std::uint32_t place = partition_.order()[i];
      const std::uint32_t triangle = centroids_[root.first + static_cast<int>(place)].triangle;
      primitives_[root.first + i] = triangle;
      const Corners& t = corners_[place];
      const auto row = [&](int c) { return Float4{t.v[0][c], t.v[1][c], t.v[2][c], t.v[0][c]}; };
      quads_[i] = PointQuad{row(0), row(1), row(2)};
      for (const Float4& v : t.v) most = lanes::max(most, lanes::abs(v));
    }
    chunks_.clear();
    chunk_at_.resize(static_cast<std::size_t>(root.count) + 1);
    for (int first = 0; first < root.count; first += cluster_sizes_[first]) {
      chunk_at_[first] = static_cast<int>(chunks_.size());
      appendDistinct(&quads_[first], cluster_sizes_[first]);
    }
    chunk_at_[root.count] = static_cast<int>(chunks_.size());
    return lanes::horizontalMax(most);
  }

  /// Appends the distinct points of a cluster to the chunks, in whole quads.
  void appendDistinct(const PointQuad* quads, int n) {
    const Float4 none = lanes::broadcast(std::numeric_limits<float>::quiet_NaN());
    const std::size_t begin = chunks_.size();
    int count = 0;
    for (int i = 0; i < n; ++i) {
      for (int k = 0; k < corners_of_each_; ++k) {
        const float x = quads[i].x[k], y = quads[i].y[k], z = quads[i].z[k];
        lanes::Int4 known = {};
        for (std::size_t j = begin; j < chunks_.size(); ++j) {
          known |= (chunks_[j].x == x) & (chunks_[j].y == y) & (chunks_[j].z == z);
        }
        if (lanes::any(known)) continue;
        const int lane = count++ % 4;
        if (lane == 0) chunks_.push_back(PointQuad{none, none, none});
        PointQuad& last = chunks_.back();
        last.x[lane] = x;
        last.y[lane] = y;
        last.z[lane] = z;
      }
    }
    PointQuad& last = chunks_.back();
    for (int lane = count % 4; lane != 0 && lane < 4; ++lane) {
      last.x[lane] = last.x[0];
      last.y[lane] = last.y[0];
      last.z[lane] = last.z[0];
    }
  }

  /// Returns where the node's extreme points are in extremes_, or -1 if it has few points.
  int fitInBlock(int index, int block_first, int below) {
    VolumeNode<S>& node = nodes_[index];
    const int n = node.num_primitives, first = node.first_primitive - block_first;
    if (n == 1) {
      node.first_child = -(static_cast<int>(primitives_[node.first_primitive]) + 1);
      corners_of_each_ == 1 ? fit_.fitPoint(index)
                            : fit_.addSmall(index, SmallNode::kPart, &quads_[first], 1);
      return -1;
    }
    if (n <= kLeafTriangles && cluster_sizes_[first] != n) {
      fit_.addSmall(index, corners_of_each_ == 1 ? SmallNode::kPoints : SmallNode::kPart,
                    &quads_[first], n);
      return -1;
    }
    const PointQuad* const chunks = &chunks_[chunk_at_[first]];
    const int num_chunks = chunk_at_[first + n] - chunk_at_[first];
    if (4 * num_chunks <= PointRows::kMost) {
      fit_.addSmall(index, SmallNode::kCluster, chunks, num_chunks);
      return -1;
    }
    if (num_chunks <= PointRows::kMost) {
      fit_.fit(index, chunks, static_cast<std::size_t>(num_chunks));
      return -1;
    }
    const auto extremesBelow = [&](int child) {
      const int at = extremes_of_[child - below];
      if (at >= 0) return extremes_[at];
      const int from = nodes_[child].first_primitive - block_first;
      const int begin = chunk_at_[from], end = chunk_at_[from + nodes_[child].num_primitives];
      return extremesOf(&chunks_[begin], static_cast<std::size_t>(end - begin));
    };
    const Extremes parts[] = {extremesBelow(node.first_child), extremesBelow(node.first_child + 1)};
    extremes_.push_back(fit_.fit(index, parts, chunks, static_cast<std::size_t>(num_chunks)));
    return static_cast<int>(extremes_.size()) - 1;
  }

  /// Keeps of a block what the nodes above it need, moved to the mesh's frame.
  void keepBlock(const Part& root, const PointFrame& frame, int of_root) {
    const Float4 shift = frame_.place(fcl::Vector3d(frame.origin));
    Extremes e = of_root >= 0 ? extremes_[of_root] : extremesOf(chunks_.data(), chunks_.size());
    e.move(shift);
    above_blocks_.emplace(root.node, e);
    block_begin_.emplace_back(root.first, all_.size());
    for (const PointQuad& q : chunks_) {
      all_.push_back(PointQuad{q.x + shift[0], q.y + shift[1], q.z + shift[2]});
    }
  }

  /// Coordinates are at most 1. Those of points that were moved had a rounding before of at most u
  /// times 2, one of the shift, and one of the sum: as many as one of a coordinate of 4.
  void fitLarge() {
    fit_.setFrame(frame_, 4);
    const auto chunkAt = [&](int first) {
      const auto at = std::lower_bound(block_begin_.begin(), block_begin_.end(),
                                       std::pair<int, std::size_t>(first, 0));
      return at == block_begin_.end() ? all_.size() : at->second;
    };
    for (auto node = large_.rbegin(); node != large_.rend(); ++node) {
      const VolumeNode<S>& at = nodes_[*node];
      const auto left = above_blocks_.find(at.first_child);
      const auto right = above_blocks_.find(at.first_child + 1);
      const std::size_t begin = chunkAt(at.first_primitive);
      const std::size_t end = chunkAt(at.first_primitive + at.num_primitives);
      const Extremes parts[] = {left->second, right->second};
      const Extremes e = fit_.fit(*node, parts, &all_[begin], end - begin);
      above_blocks_.erase(left);
      above_blocks_.erase(right);
      above_blocks_.emplace(*node, e);
    }
  }

  const MeshView<S> mesh_;
  VolumeNode<S>* const nodes_;
  unsigned int* const primitives_;
  VolumeFit<S> fit_;
  PointFrame frame_;  ///< of the mesh: coordinates are at most 1
  int num_nodes_ = 1;
  int corners_of_each_ = 3;  ///< 1: all triangles are points
  SmallVector<Centroid> centroids_;
  BlockPartition partition_;
  SmallVector<Corners> corners_;  ///< of the sample, or the block

  // These are of a block, by triangle in the order of the leaves, or by node.
  SmallVector<Part> stack_;
  SmallVector<PointQuad> quads_;    ///< three corners, and the first again
  SmallVector<int> cluster_sizes_;  ///< at the first triangle of a leaf of the prepared tree
  SmallVector<PointQuad> chunks_;   ///< the distinct points of each cluster
  SmallVector<int> chunk_at_;       ///< likewise: the cluster's first chunk
  std::vector<Extremes> extremes_;
  SmallVector<int> extremes_of_;

  // Above the blocks.
  std::vector<int> large_;                                ///< nodes, parents first
  std::vector<PointQuad> all_;                            ///< the chunks of all blocks
  std::vector<std::pair<int, std::size_t>> block_begin_;  ///< first triangle, first chunk
  std::unordered_map<int, Extremes> above_blocks_;        ///< of nodes whose parents wait
};

}  // namespace

template <typename S>
bool buildVolumes(const MeshView<S>& mesh, VolumeNode<S>* nodes, unsigned int* primitives) {
  return MeshTree<S>(mesh, nodes, primitives).run();
}

template bool buildVolumes(const MeshView<double>&, VolumeNode<double>*, unsigned int*);
template bool buildVolumes(const MeshView<float>&, VolumeNode<float>*, unsigned int*);

}  // namespace kios::engine
