// SPDX-FileCopyrightText: 2026 The fcl_kios authors
// SPDX-License-Identifier: BSD-3-Clause
#include "engine/partition.h"

#include <Eigen/Eigenvalues>
#include <algorithm>
#include <cmath>
#include <limits>

#include "engine/tree.h"
#include "volume/fit/principal_frame.h"

namespace kios::engine {
namespace {

using lanes::Float4;

constexpr float kInfinity = std::numeric_limits<float>::infinity();
constexpr int kBins = 16;
constexpr int kSweep = 32;  ///< up to so many triangles every split is tried

Float4 minimum(Float4 a, Float4 b) { return -lanes::max(-a, -b); }

struct Box {
  Float4 low = lanes::broadcast(kInfinity), high = lanes::broadcast(-kInfinity);

  void add(const Box& b) {
    low = minimum(low, b.low);
    high = lanes::max(high, b.high);
  }
  float squaredDiagonal() const {
    const Float4 d = high - low;
    return d[0] * d[0] + d[1] * d[1] + d[2] * d[2];
  }
};

/// A triangle in the frame of a node's principal axes.
struct Item {
  Box box;
  Float4 center;  ///< thrice
  std::uint32_t index;
};

float leavesOf(int n) {
  const int leaves = (n + kLeafTriangles - 1) / kLeafTriangles;
  return static_cast<float>(leaves);
}

struct Split {
  float cost = kInfinity;
  int axis = -1;
  int left = 0;  ///< triangles on the left
  int bin = 0;   ///< first bin on the right
};

class Partition {
 public:
  Partition(const std::vector<Corners>& triangles, std::vector<std::uint32_t>& order)
      : triangles_(triangles), order_(order), items_(triangles.size()) {}

  std::vector<BinaryNode> run() {
    const int n = static_cast<int>(triangles_.size());
    nodes_.reserve(n / 2 + 4);
    nodes_.push_back({0, n});
    std::vector<int> stack = {0};  // depth first: a part that fits the cache stays there
    while (!stack.empty()) {
      const int node = stack.back();
      stack.pop_back();
      split(node);
      if (nodes_[node].isLeaf()) continue;
      stack.push_back(nodes_[node].right);
      stack.push_back(nodes_[node].left);
    }
    return std::move(nodes_);
  }

 private:
  void split(int node) {
    const int first = nodes_[node].first, n = nodes_[node].count;
    if (n <= kLeafTriangles) return;
    Box bounds, centers;
    project(first, n, bounds, centers);
    nodes_[node].size = std::sqrt(bounds.squaredDiagonal());
    const int left = n <= kSweep ? sweep(first, n) : binned(first, n, centers);
    nodes_[node].left = static_cast<int>(nodes_.size());
    nodes_[node].right = nodes_[node].left + 1;
    nodes_.push_back({first, left});
    nodes_.push_back({first + left, n - left});
  }

  /// Fills items_[first, first + n) in the frame of the node's principal axes.
  void project(int first, int n, Box& bounds, Box& centers) {
    Float4 axes[3];
    principalAxes(first, n, axes);
    for (int i = first; i < first + n; ++i) {
      Item& item = items_[i];
      item.index = order_[i];
      const Corners& t = triangles_[item.index];
      Float4 p[3];
      for (int k = 0; k < 3; ++k) {
        p[k] = t.v[k][0] * axes[0] + t.v[k][1] * axes[1] + t.v[k][2] * axes[2];
      }
      item.box.low = minimum(minimum(p[0], p[1]), p[2]);
      item.box.high = lanes::max(lanes::max(p[0], p[1]), p[2]);
      item.center = p[0] + p[1] + p[2];
      bounds.add(item.box);
      centers.low = minimum(centers.low, item.center);
      centers.high = lanes::max(centers.high, item.center);
    }
  }

  /// Columns of the rotation into the frame of the principal axes of the corners' sums.
  void principalAxes(int first, int n, Float4* columns) const {
    const auto sumOf = [&](int i) {
      const Corners& t = triangles_[order_[i]];
      return t.v[0] + t.v[1] + t.v[2];
    };
    const Float4 origin = sumOf(first);
    // Rows x, y, z of the second moments: double at the end only, blocks keep sums short.
    Eigen::Vector3d sum = Eigen::Vector3d::Zero();
    Eigen::Matrix3d second = Eigen::Matrix3d::Zero();
    constexpr int kBlock = 1024;
    for (int begin = 0; begin < n; begin += kBlock) {
      Float4 s = {}, row[3] = {};
      for (int i = begin; i < std::min(n, begin + kBlock); ++i) {
        const Float4 d = sumOf(first + i) - origin;
        s += d;
        for (int r = 0; r < 3; ++r) row[r] += d[r] * d;
      }
      for (int r = 0; r < 3; ++r) {
        sum[r] += s[r];
        for (int c = 0; c < 3; ++c) second(r, c) += row[r][c];
      }
    }
    second -= sum * sum.transpose() / n;
    Eigen::SelfAdjointEigenSolver<Eigen::Matrix3d> solver;
    solver.computeDirect(second);
    const Eigen::Matrix3f axes = orthonormalAxes(solver.eigenvectors().col(2).cast<float>(),
                                                 solver.eigenvectors().col(1).cast<float>());
    for (int c = 0; c < 3; ++c) columns[c] = Float4{axes(c, 0), axes(c, 1), axes(c, 2), 0};
  }

  /// The best of all splits between neighbours along an axis. Returns the triangles on the left.
  int sweep(int first, int n) {
    Item* const items = items_.data() + first;
    Split best;
    float suffix[kSweep + 1];
    unsigned char sorted[3][kSweep];
    for (int axis = 0; axis < 3; ++axis) {
      unsigned char* const s = sorted[axis];
      for (int i = 0; i < n; ++i) {  // insertion sort, stable
        const float c = items[i].center[axis];
        int at = i;
        for (; at > 0 && items[s[at - 1]].center[axis] > c; --at) s[at] = s[at - 1];
        s[at] = static_cast<unsigned char>(i);
      }
      Box box;
      for (int i = n - 1; i > 0; --i) {
        box.add(items[s[i]].box);
        suffix[i] = box.squaredDiagonal();
      }
      box = Box();
      for (int i = 1; i < n; ++i) {
        box.add(items[s[i - 1]].box);
        const float cost = box.squaredDiagonal() * leavesOf(i) + suffix[i] * leavesOf(n - i);
        if (cost < best.cost) best = {cost, axis, i, 0};
      }
    }
    if (best.axis < 0) return n / 2;  // no finite cost
    std::uint32_t permuted[kSweep];
    for (int i = 0; i < n; ++i) permuted[i] = items[sorted[best.axis][i]].index;
    std::copy_n(permuted, n, order_.begin() + first);
    return best.left;
  }

  int binned(int first, int n, const Box& centers) {
    struct Bin {
      Box box;
      int count = 0;
    };
    Bin bins[3][kBins];
    const Float4 extent = centers.high - centers.low;
    Float4 scale;
    for (int axis = 0; axis < 3; ++axis) {
      scale[axis] = extent[axis] > 0 ? kBins * (1 - 1e-5F) / extent[axis] : 0;
      if (!(scale[axis] < kInfinity)) scale[axis] = 0;
    }
    scale[3] = 0;
    for (int i = first; i < first + n; ++i) {
      const Item& item = items_[i];
      const Float4 at = (item.center - centers.low) * scale;
      for (int axis = 0; axis < 3; ++axis) {
        Bin& bin = bins[axis][static_cast<int>(at[axis])];
        bin.box.add(item.box);
        ++bin.count;
      }
    }
    Split best;
    for (int axis = 0; axis < 3; ++axis) {
      float suffix[kBins];
      Box box;
      for (int b = kBins - 1; b > 0; --b) {
        box.add(bins[axis][b].box);
        suffix[b] = box.squaredDiagonal();
      }
      box = Box();
      int left = 0;
      for (int b = 1; b < kBins; ++b) {
        box.add(bins[axis][b - 1].box);
        left += bins[axis][b - 1].count;
        if (left == 0 || left == n) continue;
        const float cost = box.squaredDiagonal() * leavesOf(left) + suffix[b] * leavesOf(n - left);
        if (cost < best.cost) best = {cost, axis, left, b};
      }
    }
    if (best.axis < 0) return n / 2;  // all centres are one
    right_.clear();
    auto out = order_.begin() + first;
    for (int i = first; i < first + n; ++i) {
      const Item& item = items_[i];
      const Float4 at = (item.center - centers.low) * scale;
      if (static_cast<int>(at[best.axis]) < best.bin) {
        *out++ = item.index;
      } else {
        right_.push_back(item.index);
      }
    }
    std::copy(right_.begin(), right_.end(), out);
    return best.left;
  }

  const std::vector<Corners>& triangles_;
  std::vector<std::uint32_t>& order_;
  std::vector<Item> items_;  ///< of the node at hand, by position in order_
  std::vector<std::uint32_t> right_;
  std::vector<BinaryNode> nodes_;
};

}  // namespace

std::vector<BinaryNode> partition(const std::vector<Corners>& triangles,
                                  std::vector<std::uint32_t>& order) {
  return Partition(triangles, order).run();
}

}  // namespace kios::engine
