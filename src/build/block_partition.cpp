// SPDX-FileCopyrightText: 2026 The fcl_kios authors
// SPDX-License-Identifier: BSD-3-Clause
#include "build/block_partition.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

#include "build/four_axes.h"
#include "build/mesh_view.h"
#include "build/tuning.h"
#include "volume/rounding.h"

namespace kios::engine {
namespace {

using lanes::Float4;

using tuning::kBins, tuning::kSweep;

constexpr int kNoFrame = std::numeric_limits<int>::max();

/// Leaves that n triangles fill.
float leavesOf(int n) {
  const int leaves = (n + kLeafTriangles - 1) / kLeafTriangles;
  return roundedTo<float>(leaves);
}

}  // namespace

LaneBox::LaneBox()
    : low(lanes::broadcast(kInfinityFloat)), high(lanes::broadcast(-kInfinityFloat)) {}

void BlockPartition::start(const Corners* triangles, int n) {
  const auto count = static_cast<std::size_t>(n);
  triangles_ = triangles;
  order_.resize(count);
  for (int i = 0; i < n; ++i) order_[i] = static_cast<std::uint32_t>(i);
  if (items_.size() < count) items_.resize(count);
  frame_shared_.assign(count, kNoFrame);
}

int BlockPartition::split(int first, int n, bool in_halves) {
  if (n == 2) return 1;
  std::uint32_t* const items = order_.data() + first;
  const int shared = frame_shared_[items[0]];
  if (shared >= tuning::kReframe * n && (n > kLeafTriangles || shared == kNoFrame)) {
    project(items, n, principalFrame(items, n));
    for (int i = 0; i < n; ++i) frame_shared_[items[i]] = n;
  }
  if (in_halves) return halve(items, n);
  if (n <= kSweep) return sweep(items, n);
  const CutPlane plane = bestBin(items, n, 1);
  if (plane.axis < 0) return halve(items, n);
  const auto* const middle = std::partition(items, items + n, [&](std::uint32_t i) {
    return items_[i].center[plane.axis] < plane.value;
  });
  const int left = static_cast<int>(middle - items);
  return left == 0 || left == n ? halve(items, n) : left;
}

CutPlane BlockPartition::cut(const Corners* triangles, int n, float weight, LaneFrame& frame) {
  start(triangles, n);
  frame = principalFrame(order_.data(), n);
  project(order_.data(), n, frame);
  return bestBin(order_.data(), n, weight);
}

LaneFrame BlockPartition::principalFrame(const std::uint32_t* items, int n) const {
  const auto sumOf = [&](int i) {
    const Corners& t = triangles_[items[i]];
    return t.v[0] + t.v[1] + t.v[2];
  };
  const Float4 origin = sumOf(0);
  Float4 s = {}, row[3] = {};
  for (int i = 1; i < n; ++i) {
    const Float4 d = sumOf(i) - origin;
    s += d;
    for (int r = 0; r < 3; ++r) row[r] += d[r] * d;
  }
  const float part = 1.0F / roundedTo<float>(n);
  const auto about = [&](int r, int c) { return lanes::broadcast(row[r][c] - s[r] * s[c] * part); };
  const FourAxes axes = principalAxes(Scatter<Float4>{
      {}, {}, {}, about(0, 0), about(0, 1), about(0, 2), about(1, 1), about(1, 2), about(2, 2)});
  LaneFrame frame;
  for (int c = 0; c < 3; ++c) {
    frame.columns[c] = Float4{axes.column[0][c][0], axes.column[1][c][0], axes.column[2][c][0], 0};
  }
  return frame;
}

void BlockPartition::project(const std::uint32_t* items, int n, const LaneFrame& frame) {
  for (int i = 0; i < n; ++i) {
    const Corners& t = triangles_[items[i]];
    Item& item = items_[items[i]];
    Float4 p[3];
    for (int k = 0; k < 3; ++k) {
      const Float4 v = t.v[k];
      p[k] = v[0] * frame.columns[0] + v[1] * frame.columns[1] + v[2] * frame.columns[2];
    }
    item.box.low = lanes::min(lanes::min(p[0], p[1]), p[2]);
    item.box.high = lanes::max(lanes::max(p[0], p[1]), p[2]);
    item.center = p[0] + p[1] + p[2];
  }
}

LaneBox BlockPartition::centersOf(const std::uint32_t* items, int n) const {
  LaneBox centers;
  for (int i = 0; i < n; ++i) centers.add(items_[items[i]].center);
  return centers;
}

int BlockPartition::halve(std::uint32_t* items, int n) const {
  std::nth_element(items, items + n / 2, items + n, [this](std::uint32_t i, std::uint32_t j) {
    return items_[i].center[0] < items_[j].center[0];
  });
  return n / 2;
}

CutPlane BlockPartition::bestBin(const std::uint32_t* items, int n, float weight) const {
  struct Bin {
    LaneBox box;
    int count = 0;
  };
  Bin bins[3][kBins];
  const LaneBox centers = centersOf(items, n);
  const Float4 extent = centers.high - centers.low;
  Float4 scale = {};
  for (int axis = 0; axis < 3; ++axis) {
    scale[axis] = extent[axis] > 0 ? kBins * (1 - 1e-5F) / extent[axis] : 0;
    if (!(scale[axis] < kInfinityFloat)) scale[axis] = 0;
  }
  for (int i = 0; i < n; ++i) {
    const Item& item = items_[items[i]];
    const Float4 at = (item.center - centers.low) * scale;
    for (int axis = 0; axis < 3; ++axis) {
      Bin& bin = bins[axis][static_cast<int>(at[axis])];
      bin.box.add(item.box);
      ++bin.count;
    }
  }
  const auto sizeOf = [weight](int of) {
    return leavesOf(weight == 1 ? of : static_cast<int>(weight * roundedTo<float>(of)));
  };
  CutPlane best;
  float best_cost = kInfinityFloat;
  for (int axis = 0; axis < 3; ++axis) {
    if (scale[axis] == 0) continue;
    float suffix[kBins];
    LaneBox box;
    for (int b = kBins - 1; b > 0; --b) {
      box.add(bins[axis][b].box);
      suffix[b] = box.squaredDiagonal();
    }
    box = LaneBox();
    int left = 0;
    for (int b = 1; b < kBins; ++b) {
      box.add(bins[axis][b - 1].box);
      left += bins[axis][b - 1].count;
      if (left == 0 || left == n) continue;
      const float cost = box.squaredDiagonal() * sizeOf(left) + suffix[b] * sizeOf(n - left);
      if (cost < best_cost) {
        best_cost = cost;
        best = {axis, centers.low[axis] + roundedTo<float>(b) / scale[axis]};
      }
    }
  }
  return best;
}

/// The best of all splits between neighbours along the two axes that the centroids spread most
/// along; along one for what is a leaf of the prepared tree, where triangles count, not leaves.
int BlockPartition::sweep(std::uint32_t* items, int n) const {
  const LaneBox centers = centersOf(items, n);
  const Float4 extent = centers.high - centers.low;
  const auto axes = longestFirst(extent);
  if (!(extent[axes[0]] > 0)) return n / 2;  // the centroids are one
  float sizes[kSweep];
  for (int i = 1; i < n; ++i) {
    sizes[i] = n > kLeafTriangles ? leavesOf(i) : roundedTo<float>(i);
  }
  float best_cost = kInfinityFloat;
  int best_left = n / 2;
  std::uint32_t best[kSweep];
  std::copy_n(items, n, best);
  const int num_axes = n > kLeafTriangles ? 2 : 1;
  for (int a = 0; a < num_axes; ++a) {
    std::pair<float, std::uint32_t> sorted[kSweep];
    for (int i = 0; i < n; ++i) sorted[i] = {items_[items[i]].center[axes[a]], items[i]};
    std::sort(sorted, sorted + n);
    float suffix[kSweep];
    LaneBox box;
    for (int i = n - 1; i > 0; --i) {
      box.add(items_[sorted[i].second].box);
      suffix[i] = box.squaredDiagonal();
    }
    box = LaneBox();
    int left = -1;
    for (int i = 1; i < n; ++i) {
      box.add(items_[sorted[i - 1].second].box);
      const float cost = box.squaredDiagonal() * sizes[i] + suffix[i] * sizes[n - i];
      if (cost < best_cost) {
        best_cost = cost;
        left = i;
      }
    }
    if (left < 0) continue;
    best_left = left;
    for (int i = 0; i < n; ++i) best[i] = sorted[i].second;
  }
  std::copy_n(best, n, items);
  return best_left;
}

}  // namespace kios::engine
