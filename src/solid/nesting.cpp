// SPDX-FileCopyrightText: 2026 The fcl_kios authors
// SPDX-License-Identifier: BSD-3-Clause
#include "solid/nesting.h"

#include <algorithm>
#include <limits>
#include <utility>

#include "solid/winding.h"
#include "volume/instantiate.h"

namespace kios {

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
