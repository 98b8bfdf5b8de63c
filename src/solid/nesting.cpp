// SPDX-FileCopyrightText: 2026 The fcl_kios authors
// SPDX-License-Identifier: BSD-3-Clause
#include "solid/nesting.h"

#include <algorithm>
#include <limits>
#include <utility>

#include "solid/winding.h"
#include "volume/instantiate.h"

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

template <typename S>
TriangleVertices<double> Nesting<S>::cornersOf(int triangle) const {
  TriangleVertices<double> corners;
  for (std::size_t k = 0; k < 3; ++k) {
    corners[k] = mesh_.corner(static_cast<std::size_t>(triangle), k).template cast<double>();
  }
  return corners;
}

template <typename S>
Nesting<S>::Nesting(const engine::MeshView<S>& mesh, const Components<S>& parts)
    : mesh_(mesh), components_(parts) {
  const auto count = static_cast<std::size_t>(parts.closedness().components);
  const auto trianglesOf = [&](std::size_t c) { return parts.trianglesOf(static_cast<int>(c)); };
  parts_.resize(count);
  for (std::size_t c = 0; c < count; ++c) {
    Part& part = parts_[c];
    part.low = part.high = cornersOf(*trianglesOf(c).begin())[0];
    for (const int t : trianglesOf(c)) {
      for (const Point<double>& p : cornersOf(t)) {
        part.low = part.low.cwiseMin(p);
        part.high = part.high.cwiseMax(p);
      }
    }
    largest_ =
        std::max({largest_, part.low.cwiseAbs().maxCoeff(), part.high.cwiseAbs().maxCoeff()});
  }
  largest_ = std::max(largest_, std::numeric_limits<double>::min());
  std::vector<ShadowGrid::Box> boxes(count);
  for (std::size_t c = 0; c < count; ++c) {
    for (const int t : trianglesOf(c)) boxes[c].extend(ShadowGrid::boxOf(cornersOf(t), largest_));
  }
  boxes_.emplace(std::move(boxes), largest_);
}

template <typename S>
bool Nesting<S>::liesWithinOthers(int component) {
  for (const int own : components_.trianglesOf(component)) {
    for (const Point<double>& vertex : cornersOf(own)) {
      const RayCrossing ray(vertex, windingDirection(), largest_);
      boxes_->find(vertex, near_parts_);
      PointPlace place;
      for (const std::size_t c : near_parts_) {
        Part& part = parts_[c];
        if (static_cast<int>(c) == component || (vertex.array() < part.low.array()).any() ||
            (vertex.array() > part.high.array()).any()) {
          continue;
        }
        const auto triangles = components_.trianglesOf(static_cast<int>(c));
        if (!part.triangles) {
          std::vector<ShadowGrid::Box> boxes;
          for (const int t : triangles) boxes.push_back(ShadowGrid::boxOf(cornersOf(t), largest_));
          part.triangles.emplace(std::move(boxes), largest_);
        }
        part.triangles->find(vertex, near_);
        for (const std::size_t t : near_) {
          if (place.add(ray.cross(cornersOf(triangles.first[t])))) break;
        }
        if (place.on_surface) break;
      }
      if (!place.on_surface) return place.inside();
    }
  }
  return true;
}

KIOS_INSTANTIATE_CLASS(Nesting);

}  // namespace kios
