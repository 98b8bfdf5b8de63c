// SPDX-FileCopyrightText: 2026 The fcl_kios authors
// SPDX-License-Identifier: BSD-3-Clause
#include "linkage/obstacle_tree.h"

#include <algorithm>
#include <numeric>
#include <utility>

#include "linkage/tuning.h"
#include "volume/rounding.h"

namespace kios::articulated {
namespace {

float upToFloat(double v) { return v > 0 ? roundUp<float>(v) : -roundDown<float>(-v); }

/// An end of a box, a number for infinite boxes too.
double bounded(float v) { return std::clamp<double>(v, -0x1p127, 0x1p127); }

}  // namespace

void ObstacleTree::Node::clear(int lane) {
  for (int i = 0; i < 3; ++i) {
    low[i][lane] = kInfinityFloat;
    high[i][lane] = -kInfinityFloat;
  }
  count[lane] = 0;
  used &= ~(1U << lane);
}

// Where one box holds the others, as those of half-spaces and rooms do, its lane grows least each
// time. Lanes of most of the boxes take no more, so that a million boxes get no deeper than
// kDeepest. Equal boxes come to the lane of the fewest.
int ObstacleTree::laneFor(const Node& node, const Box& added) {
  const int total = std::accumulate(node.count, node.count + kLanes, 0);
  std::pair<double, int> least = {kInfinity, 0};
  int best = 0;
  for (int lane = 0; lane < kLanes; ++lane) {
    if (node.count[lane] > total / 2) continue;
    double growth = 0;
    for (int i = 0; i < 3; ++i) {
      growth += std::max(0.0, bounded(added.high[i]) - bounded(node.high[i][lane])) +
                std::max(0.0, bounded(node.low[i][lane]) - bounded(added.low[i]));
    }
    const std::pair grown(growth, node.count[lane]);
    if (grown < least) best = lane;
    least = std::min(least, grown);
  }
  return best;
}

int ObstacleTree::addNode(int parent) {
  const int node = static_cast<int>(nodes_.size());
  nodes_.emplace_back();
  nodes_[node].parent = parent;
  if (parent >= 0) nodes_[parent / kLanes].child[parent % kLanes] = node;
  return node;
}

void ObstacleTree::put(int body, int node) {
  Node& at = nodes_[node];
  Box& box = boxes_[body];
  const int lane = __builtin_ctz(~at.used);
  for (int i = 0; i < 3; ++i) {
    at.low[i][lane] = box.low[i];
    at.high[i][lane] = box.high[i];
  }
  at.count[lane] = 1;
  at.child[lane] = ~body;
  at.used |= 1U << lane;
  box.place = node * kLanes + lane;
}

void ObstacleTree::insert(const ObstacleBox& box) {
  if (static_cast<std::size_t>(box.body) >= boxes_.size()) boxes_.resize(box.body + 1);
  Box& added = boxes_[box.body];
  for (int i = 0; i < 3; ++i) {
    added.low[i] = -upToFloat(-box.low[i]);
    added.high[i] = upToFloat(box.high[i]);
  }
  added.length = box.length;
  lengths_.insert(box.length);
  ++size_;
  ++changes_;
  if (nodes_.empty()) addNode(-1);
  constexpr unsigned int kAll = (1U << kLanes) - 1;
  int node = 0, depth = 1;
  for (; nodes_[node].used == kAll; ++depth) {
    const int best = laneFor(nodes_[node], added);
    const int there = nodes_[node].child[best];
    // The box that is there gets a node, and this one comes to it.
    node = there < 0 ? addNode(node * kLanes + best) : there;
    if (there < 0) put(~there, node);
  }
  put(box.body, node);
  refit(node);
  if (size_ <= tuning::kFewObstacles || 2 * changes_ > size_ || depth > kDeepest) rebuild();
}

bool ObstacleTree::remove(int body) {
  if (static_cast<std::size_t>(body) >= boxes_.size() || boxes_[body].place < 0) return false;
  const int place = std::exchange(boxes_[body].place, -1);
  nodes_[place / kLanes].clear(place % kLanes);
  refit(place / kLanes);
  --size_;
  ++changes_;
  lengths_.erase(lengths_.find(boxes_[body].length));
  return true;
}

void ObstacleTree::refit(int node) {
  for (int place = nodes_[node].parent; place >= 0; place = nodes_[place / kLanes].parent) {
    gather(place);
  }
}

void ObstacleTree::gather(int place) {
  Node& node = nodes_[place / kLanes];
  const int lane = place % kLanes;
  const Node& below = nodes_[node.child[lane]];
  for (int i = 0; i < 3; ++i) {
    node.low[i][lane] = *std::min_element(below.low[i], below.low[i] + kLanes);
    node.high[i][lane] = *std::max_element(below.high[i], below.high[i] + kLanes);
  }
  node.count[lane] = std::accumulate(below.count, below.count + kLanes, 0);
  if (below.used != 0) {
    node.used |= 1U << lane;
  } else {
    node.clear(lane);
  }
}

void ObstacleTree::rebuild() {
  std::vector<int> bodies;
  bodies.reserve(static_cast<std::size_t>(size_));
  for (std::size_t i = 0; i < boxes_.size(); ++i) {
    if (boxes_[i].place >= 0) bodies.push_back(static_cast<int>(i));
  }
  changes_ = 0;
  nodes_.clear();
  build(bodies.data(), bodies.data() + bodies.size(), -1);
}

int* ObstacleTree::halve(int* begin, int* end) const {
  const auto middle = [this](int body, int i) {
    return bounded(boxes_[body].low[i]) + bounded(boxes_[body].high[i]);
  };
  double longest = -1;
  int axis = 0;
  for (int i = 0; i < 3; ++i) {
    double low = kInfinity, high = -low;
    for (const int* body = begin; body < end; ++body) {
      low = std::min(low, middle(*body, i));
      high = std::max(high, middle(*body, i));
    }
    if (high - low > longest) axis = i;
    longest = std::max(longest, high - low);
  }
  int* const half = begin + (end - begin + 1) / 2;
  std::nth_element(begin, half, end, [&](int a, int b) {
    return std::pair(middle(a, axis), a) < std::pair(middle(b, axis), b);
  });
  return half;
}

// The centres are halved along the longest side, twice a node.
int ObstacleTree::build(int* begin, int* end, int parent) {
  const int node = addNode(parent);
  if (end - begin <= kLanes) {
    for (int* body = begin; body < end; ++body) put(*body, node);
    return node;
  }
  int* const half = halve(begin, end);
  int* const cuts[kLanes + 1] = {begin, halve(begin, half), half, halve(half, end), end};
  for (int lane = 0; lane < kLanes; ++lane) {
    if (cuts[lane + 1] - cuts[lane] == 1) {
      put(*cuts[lane], node);
    } else {
      const int place = node * kLanes + lane;
      build(cuts[lane], cuts[lane + 1], place);
      gather(place);
    }
  }
  return node;
}

}  // namespace kios::articulated
