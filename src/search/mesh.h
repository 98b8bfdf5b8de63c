// SPDX-FileCopyrightText: 2026 The fcl_kios authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstddef>
#include <type_traits>

#include "build/mesh_view.h"
#include "fcl_kios/triangle/triangle.h"
#include "fcl_kios/volume/kios.h"
#include "tree/tree.h"

namespace kios {

/// A finished mesh as queries see it: in double, which holds the floats of a float model as they
/// are. It is a view, which the model must outlive; see meshOf().
class Mesh {
 public:
  template <typename S>
  Mesh(const engine::MeshView<S>& mesh, const engine::Tree& tree, const kIOS<S>& root)
      : triangles_{nullptr, mesh.num_vertices, mesh.triangles, mesh.num_triangles},
        tree_(&tree),
        center_(root.center0.template cast<double>()),
        radius_(root.radius0) {
    if constexpr (std::is_same<S, double>::value) {
      triangles_.vertices = mesh.vertices;
    } else {
      floats_ = mesh.vertices;
    }
  }

  std::size_t numVertices() const { return triangles_.num_vertices; }
  std::size_t numTriangles() const { return triangles_.num_triangles; }
  Pointd vertex(std::size_t i) const {
    return floats_ ? Pointd(floats_[i].cast<double>()) : triangles_.vertices[i];
  }
  Pointd corner(std::size_t triangle, std::size_t k) const {
    return vertex(triangles_.index(triangle, k));
  }
  TriangleVerticesd triangle(std::size_t t) const {
    return {corner(t, 0), corner(t, 1), corner(t, 2)};
  }
  const engine::Tree& tree() const { return *tree_; }
  /// The central sphere of the root volume.
  const Pointd& center() const { return center_; }
  double radius() const { return radius_; }

 private:
  engine::MeshView<double> triangles_;  ///< without vertices if they are floats
  const Pointf* floats_ = nullptr;
  const engine::Tree* tree_;
  Pointd center_;
  double radius_;
};

}  // namespace kios
