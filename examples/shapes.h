// SPDX-FileCopyrightText: 2026 The fcl_kios authors
// SPDX-License-Identifier: BSD-3-Clause
//
// Meshes for the examples.
#pragma once

#include <cmath>
#include <vector>

#include <fcl/common/types.h>
#include <fcl/math/triangle.h>

namespace shapes {

constexpr double kPi = 3.14159265358979323846;

template <typename S>
struct Mesh {
  std::vector<fcl::Vector3<S>> vertices;
  std::vector<fcl::Triangle> triangles;
};

/// Adds two triangles for each cell of a grid of vertices, whose rows have `stride` vertices; a
/// cell's corners are `at(i, j)` for rows i and columns j.
template <typename S, typename Index>
void addGrid(Mesh<S>& mesh, int rows, int columns, const Index& at) {
  for (int i = 0; i < rows; ++i) {
    for (int j = 0; j < columns; ++j) {
      const std::size_t a = at(i, j), b = at(i + 1, j), c = at(i, j + 1), d = at(i + 1, j + 1);
      mesh.triangles.emplace_back(a, b, c);
      mesh.triangles.emplace_back(b, d, c);
    }
  }
}

/// Adds a box around `centre`, with n x n squares of two triangles on each face. It is closed, as
/// faces have equal vertices where they meet, and its normals point outwards: a solid.
template <typename S>
void addBox(Mesh<S>& mesh, const fcl::Vector3<S>& size, const fcl::Vector3<S>& centre, int n) {
  for (int axis = 0; axis < 3; ++axis) {
    for (const bool upper : {false, true}) {
      const std::size_t first = mesh.vertices.size();
      for (int i = 0; i <= n; ++i) {
        for (int j = 0; j <= n; ++j) {
          // From side to side the same numbers, whichever face they are of.
          const auto along = [n](int k) {
            return static_cast<S>(2 * k - n) / static_cast<S>(2 * n);
          };
          fcl::Vector3<S> p;
          p[axis] = upper ? S(0.5) : S(-0.5);
          p[(axis + 1) % 3] = along(i);
          p[(axis + 2) % 3] = along(j);
          mesh.vertices.push_back(p.cwiseProduct(size) + centre);
        }
      }
      addGrid(mesh, n, n, [first, n, upper](int i, int j) {
        return first + static_cast<std::size_t>(upper ? i * (n + 1) + j : j * (n + 1) + i);
      });
    }
  }
}

/// Torus about z with bumps: radii `ring` and `tube`, 2 m n triangles.
template <typename S>
Mesh<S> bumpyTorus(S ring, S tube, int m, int n) {
  Mesh<S> mesh;
  for (int i = 0; i < m; ++i) {
    for (int j = 0; j < n; ++j) {
      const double u = 2 * kPi * i / m, v = 2 * kPi * j / n;
      const double r = static_cast<double>(tube) * (1 + 0.1 * std::sin(9 * u) * std::cos(5 * v));
      const double w = static_cast<double>(ring) + r * std::cos(v);
      mesh.vertices.push_back(
          fcl::Vector3d(w * std::cos(u), w * std::sin(u), r * std::sin(v)).cast<S>());
    }
  }
  addGrid(mesh, m, n,
          [m, n](int i, int j) { return static_cast<std::size_t>((i % m) * n + j % n); });
  return mesh;
}

}  // namespace shapes
