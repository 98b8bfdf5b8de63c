// SPDX-FileCopyrightText: 2026 The fcl_kios authors
// SPDX-License-Identifier: BSD-3-Clause
#include "solid/shadow_grid.h"

#include <algorithm>
#include <utility>

#include "solid/winding.h"

namespace kios {
namespace {

constexpr int kLevels = 24;
constexpr double kPad = 0x1p-46;

}  // namespace

// Coordinates are scaled by the largest, so that nothing overflows: shadows lie within 2, and are
// right to 2^-50.
ShadowGrid::Shadow ShadowGrid::shadowOf(const Point<double>& p, double largest) {
  const Point<double> d = windingDirection(), q = p / largest;
  return {q[0] - d[0] / d[2] * q[2], q[1] - d[1] / d[2] * q[2]};
}

ShadowGrid::Square ShadowGrid::squareOf(const Shadow& p, int level) const {
  const double count = static_cast<double>(1U << level);
  const auto index = [&](int c) {
    return static_cast<std::uint32_t>(std::clamp((p[c] - low_[c]) / size_ * count, 0.0, count - 1));
  };
  return {level, index(0), index(1)};
}

ShadowGrid::Box ShadowGrid::boxOf(const TriangleVertices<double>& corners, double largest) {
  Box box;
  for (const Point<double>& corner : corners) {
    const Shadow p = shadowOf(corner, largest);
    box.extend({p, p});
  }
  box.low.array() -= kPad;
  box.high.array() += kPad;
  return box;
}

ShadowGrid::ShadowGrid(std::vector<Box> boxes, double largest)
    : boxes_(std::move(boxes)), largest_(largest) {
  Box all;
  for (const Box& box : boxes_) all.extend(box);
  low_ = all.low;
  size_ = std::max((all.high - all.low).maxCoeff(), kPad);
  entries_.reserve(4 * boxes_.size());
  for (std::size_t i = 0; i < boxes_.size(); ++i) {
    const double extent = (boxes_[i].high - boxes_[i].low).maxCoeff();
    int level = 0;
    while (level + 1 < kLevels && 2 * extent * static_cast<double>(1U << level) <= size_) ++level;
    const Square from = squareOf(boxes_[i].low, level), to = squareOf(boxes_[i].high, level);
    for (std::uint32_t x = from.i; x <= to.i; ++x) {
      for (std::uint32_t y = from.j; y <= to.j; ++y) entries_.push_back({{level, x, y}, i});
    }
  }
  std::sort(entries_.begin(), entries_.end());
  for (const Entry& e : entries_) {
    if (levels_.empty() || levels_.back() != e.square.level) levels_.push_back(e.square.level);
  }
}

// squareOf() never falls as a coordinate grows, so that a point within a box is in one of the
// squares from that of its low corner to that of its high one.
void ShadowGrid::find(const Point<double>& p, std::vector<std::size_t>& things) const {
  things.clear();
  const Shadow shadow = shadowOf(p, largest_);
  for (const int level : levels_) {
    const auto range =
        std::equal_range(entries_.begin(), entries_.end(), Entry{squareOf(shadow, level), 0});
    for (auto e = range.first; e != range.second; ++e) {
      const Box& box = boxes_[e->thing];
      if ((shadow.array() >= box.low.array()).all() && (shadow.array() <= box.high.array()).all()) {
        things.push_back(e->thing);
      }
    }
  }
}

}  // namespace kios
