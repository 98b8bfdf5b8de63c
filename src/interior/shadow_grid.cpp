// SPDX-FileCopyrightText: 2026 The fcl_kios authors
// SPDX-License-Identifier: BSD-3-Clause
#include "interior/shadow_grid.h"

#include <algorithm>
#include <limits>

#include "interior/winding.h"

namespace kios {
namespace {

constexpr int kLevels = 24;

}  // namespace

// Coordinates are scaled by the largest, so that nothing overflows: shadows lie within 2, and are
// right to 2^-50.
ShadowGrid::Shadow ShadowGrid::shadowOf(const fcl::Vector3d& p) const {
  const fcl::Vector3d d = windingDirection(), q = p / largest_;
  return {q[0] - d[0] / d[2] * q[2], q[1] - d[1] / d[2] * q[2]};
}

ShadowGrid::Square ShadowGrid::squareOf(const Shadow& p, int level) const {
  const double count = static_cast<double>(1U << level);
  const auto index = [&](int c) {
    return static_cast<std::uint32_t>(std::clamp((p[c] - low_[c]) / size_ * count, 0.0, count - 1));
  };
  return {level, index(0), index(1)};
}

template <typename S>
ShadowGrid::ShadowGrid(const engine::MeshView<S>& mesh) {
  for (std::size_t t = 0; t < mesh.num_triangles; ++t) {
    for (std::size_t k = 0; k < 3; ++k) {
      largest_ = std::max(largest_, double{mesh.corner(t, k).cwiseAbs().maxCoeff()});
    }
  }
  largest_ = std::max(largest_, std::numeric_limits<double>::min());
  boxes_.resize(mesh.num_triangles);
  constexpr double kPad = 0x1p-46;
  Shadow high = Shadow::Constant(-4);
  low_ = -high;
  for (std::size_t t = 0; t < mesh.num_triangles; ++t) {
    Box& box = boxes_[t];
    box = {Shadow::Constant(4), Shadow::Constant(-4)};
    for (std::size_t k = 0; k < 3; ++k) {
      const Shadow p = shadowOf(mesh.corner(t, k).template cast<double>());
      box.low = box.low.cwiseMin(p);
      box.high = box.high.cwiseMax(p);
    }
    box.low.array() -= kPad;
    box.high.array() += kPad;
    low_ = low_.cwiseMin(box.low);
    high = high.cwiseMax(box.high);
  }
  size_ = std::max((high - low_).maxCoeff(), kPad);
  entries_.reserve(4 * mesh.num_triangles);
  for (std::size_t t = 0; t < mesh.num_triangles; ++t) {
    const double extent = (boxes_[t].high - boxes_[t].low).maxCoeff();
    int level = 0;
    while (level + 1 < kLevels && 2 * extent * static_cast<double>(1U << level) <= size_) ++level;
    const Square from = squareOf(boxes_[t].low, level), to = squareOf(boxes_[t].high, level);
    for (std::uint32_t i = from.i; i <= to.i; ++i) {
      for (std::uint32_t j = from.j; j <= to.j; ++j) entries_.push_back({{level, i, j}, t});
    }
  }
  std::sort(entries_.begin(), entries_.end());
  for (const Entry& e : entries_) {
    if (levels_.empty() || levels_.back() != e.square.level) levels_.push_back(e.square.level);
  }
}

// squareOf() never falls as a coordinate grows, so that a point within a box is in one of the
// squares from that of its low corner to that of its high one.
void ShadowGrid::find(const fcl::Vector3d& p, std::vector<std::size_t>& triangles) const {
  triangles.clear();
  const Shadow shadow = shadowOf(p);
  for (const int level : levels_) {
    const auto range =
        std::equal_range(entries_.begin(), entries_.end(), Entry{squareOf(shadow, level), 0});
    for (auto e = range.first; e != range.second; ++e) {
      const Box& box = boxes_[e->triangle];
      if ((shadow.array() >= box.low.array()).all() && (shadow.array() <= box.high.array()).all()) {
        triangles.push_back(e->triangle);
      }
    }
  }
}

template ShadowGrid::ShadowGrid(const engine::MeshView<double>&);
template ShadowGrid::ShadowGrid(const engine::MeshView<float>&);

}  // namespace kios
