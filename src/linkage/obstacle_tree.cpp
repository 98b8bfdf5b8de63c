// SPDX-FileCopyrightText: 2026 The fcl_kios authors
// SPDX-License-Identifier: BSD-3-Clause
#include "linkage/obstacle_tree.h"

#include <algorithm>
#include <array>
#include <utility>

#include "volume/rounding.h"

namespace kios::articulated {
namespace {

float upToFloat(double v) { return v > 0 ? roundUp<float>(v) : -roundDown<float>(-v); }

}  // namespace

ObstacleTree::ObstacleTree(std::vector<ObstacleBox> boxes) {
  nodes_.reserve(boxes.size());
  if (!boxes.empty()) build(boxes, 0, boxes.size());
}

// The centres are halved along the longest side, twice a node.
int ObstacleTree::build(std::vector<ObstacleBox>& boxes, std::size_t begin, std::size_t end) {
  using Range = std::pair<std::size_t, std::size_t>;
  const auto halve = [&boxes](const Range& range) {
    const auto middle = [](const ObstacleBox& box, int i) {
      return std::clamp(box.low[i], -0x1p1000, 0x1p1000) +
             std::clamp(box.high[i], -0x1p1000, 0x1p1000);
    };
    double longest = -1;
    int axis = 0;
    for (int i = 0; i < 3; ++i) {
      double low = kInfinity, high = -low;
      for (std::size_t b = range.first; b < range.second; ++b) {
        low = std::min(low, middle(boxes[b], i));
        high = std::max(high, middle(boxes[b], i));
      }
      if (high - low > longest) axis = i;
      longest = std::max(longest, high - low);
    }
    const std::size_t half = range.first + (range.second - range.first + 1) / 2;
    const auto at = [&boxes](std::size_t i) { return boxes.begin() + static_cast<long>(i); };
    std::nth_element(at(range.first), at(half), at(range.second),
                     [&](const ObstacleBox& a, const ObstacleBox& b) {
                       return std::pair(middle(a, axis), a.body) <
                              std::pair(middle(b, axis), b.body);
                     });
    return half;
  };
  std::vector<Range> parts = {{begin, end}};
  if (end - begin <= kLanes) {
    parts.clear();
    for (std::size_t b = begin; b < end; ++b) parts.emplace_back(b, b + 1);
  } else {
    const std::size_t half = halve(parts[0]);
    const Range first(begin, half), second(half, end);
    const std::size_t quarter = halve(first), last = halve(second);
    parts = {{begin, quarter}, {quarter, half}, {half, last}, {last, end}};
  }

  const auto index = nodes_.size();
  nodes_.emplace_back();
  Node node;
  for (int lane = 0; lane < kLanes; ++lane) {
    const bool used =
        lane < static_cast<int>(parts.size()) && parts[lane].first < parts[lane].second;
    for (int i = 0; i < 3; ++i) {
      double low = kInfinity, high = -low;
      for (std::size_t b = used ? parts[lane].first : 0; used && b < parts[lane].second; ++b) {
        low = std::min(low, boxes[b].low[i]);
        high = std::max(high, boxes[b].high[i]);
      }
      node.low[i][lane] = -upToFloat(-low);
      node.high[i][lane] = upToFloat(high);
    }
    node.child[lane] = 0;
    if (!used) continue;
    node.used |= 1U << lane;
    const auto [from, to] = parts[lane];
    node.child[lane] = to - from == 1 ? ~boxes[from].body : build(boxes, from, to);
  }
  nodes_[index] = node;
  return static_cast<int>(index);
}

}  // namespace kios::articulated
