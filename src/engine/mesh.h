// SPDX-FileCopyrightText: 2026 The fcl_kios authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstddef>

#include <fcl/common/types.h>
#include <fcl/math/triangle.h>

namespace kios::engine {

/// A mesh as it lies in a model: not owned.
template <typename S>
struct MeshView {
  const fcl::Vector3<S>* vertices = nullptr;
  std::size_t num_vertices = 0;
  const fcl::Triangle* triangles = nullptr;
  std::size_t num_triangles = 0;

  const fcl::Vector3<S>& corner(std::size_t triangle, std::size_t k) const {
    return vertices[triangles[triangle][k]];
  }
};

}  // namespace kios::engine
