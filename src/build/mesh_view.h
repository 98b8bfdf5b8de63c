// SPDX-FileCopyrightText: 2026 The fcl_kios authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <array>
#include <cstddef>
#include <cstring>
#include <type_traits>

#include <fcl/common/types.h>
#include <fcl/math/triangle.h>

namespace kios::engine {

/// The most triangles of a leaf of the wide tree: partitions cut towards parts of that size.
constexpr int kLeafTriangles = 8;

/// A mesh as it lies in a model: not owned.
template <typename S>
struct MeshView {
  const fcl::Vector3<S>* vertices = nullptr;
  std::size_t num_vertices = 0;
  const fcl::Triangle* triangles = nullptr;
  std::size_t num_triangles = 0;

  const fcl::Vector3<S>& corner(std::size_t triangle, std::size_t k) const {
    return vertices[index(triangle, k)];
  }

  /// Lowest and highest corner of the box around the vertices that triangles use.
  std::array<fcl::Vector3d, 2> box() const {
    fcl::Vector3<S> low = corner(0, 0), high = low;
    for (std::size_t t = 0; t < num_triangles; ++t) {
      for (std::size_t k = 0; k < 3; ++k) {
        low = low.cwiseMin(corner(t, k));
        high = high.cwiseMax(corner(t, k));
      }
    }
    return {low.template cast<double>(), high.template cast<double>()};
  }

  /// The vertex at a triangle's corner. fcl::Triangle is three of them, but reads one by a call.
  std::size_t index(std::size_t triangle, std::size_t k) const {
    static_assert(sizeof(fcl::Triangle) == 3 * sizeof(std::size_t) &&
                  std::is_standard_layout<fcl::Triangle>::value);
    std::size_t vertex;
    std::memcpy(&vertex,
                reinterpret_cast<const unsigned char*>(triangles + triangle) + k * sizeof(vertex),
                sizeof(vertex));
    return vertex;
  }
};

}  // namespace kios::engine
