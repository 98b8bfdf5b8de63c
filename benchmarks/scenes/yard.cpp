// SPDX-FileCopyrightText: 2026 The fcl_kios authors
// SPDX-License-Identifier: BSD-3-Clause

#include "yard.h"

#include <cstddef>

#include "shapes.h"

namespace kios::scenes {

Mesh withPosts(const Mesh& place, double at) {
  Mesh mesh = place;
  const Mesh box = subdividedBox({0.2, 0.2, 1}, 1);
  for (const double x : {-at, at}) {
    for (const double y : {-at, at}) {
      const std::size_t n = mesh.vertices.size();
      for (const fcl::Vector3d& v : box.vertices) {
        mesh.vertices.push_back(v + fcl::Vector3d(x, y, 0.5));
      }
      for (const fcl::Triangle& t : box.triangles) {
        mesh.triangles.emplace_back(n + t[0], n + t[1], n + t[2]);
      }
    }
  }
  return mesh;
}

}  // namespace kios::scenes
