// SPDX-FileCopyrightText: 2026 The fcl_kios authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstddef>
#include <cstdint>
#include <type_traits>
#include <vector>

#include "build/mesh_view.h"
#include "fcl_kios/triangle.h"
#include "fcl_kios/volume.h"
#include "tree/tree.h"
#include "tree/weld.h"

namespace kios {

class Attachment;

/// A finished mesh as queries see it: in double, which holds the floats of a float model as they
/// are. It is a view, which the model must outlive; see meshOf().
class Mesh {
 public:
  /// Triangles alone, which no query can search.
  template <typename S>
  explicit Mesh(const engine::MeshView<S>& mesh)
      : triangles_{nullptr, mesh.num_vertices, mesh.triangles, mesh.num_triangles} {
    if constexpr (std::is_same<S, double>::value) {
      triangles_.vertices = mesh.vertices;
    } else {
      floats_ = mesh.vertices;
    }
  }
  template <typename S>
  Mesh(const engine::MeshView<S>& mesh, const engine::Tree& tree, const kIOS<S>& root,
       const Attachment* attachment)
      : Mesh(mesh) {
    tree_ = &tree;
    attachment_ = attachment;
    center_ = root.center0.template cast<double>();
    radius_ = root.radius0;
  }

  std::size_t numVertices() const { return triangles_.num_vertices; }
  std::size_t numTriangles() const { return triangles_.num_triangles; }
  Pointd vertex(std::size_t i) const {
    return floats_ ? Pointd(floats_[i].cast<double>()) : triangles_.vertices[i];
  }
  Pointd corner(std::size_t triangle, std::size_t k) const { return vertex(index(triangle, k)); }
  TriangleVerticesd triangle(std::size_t t) const {
    return {corner(t, 0), corner(t, 1), corner(t, 2)};
  }
  std::size_t index(std::size_t triangle, std::size_t k) const {
    return triangles_.index(triangle, k);
  }
  /// For each vertex that a triangle uses, the first one with equal coordinates.
  std::vector<std::uint32_t> weld() const {
    if (!floats_) return engine::weld(triangles_);
    return engine::weld(
        engine::MeshView<float>{floats_, numVertices(), triangles_.triangles, numTriangles()});
  }
  const engine::Tree& tree() const { return *tree_; }
  /// What a layer above keeps with the model; may be nullptr.
  const Attachment* attachment() const { return attachment_; }
  /// The central sphere of the root volume.
  const Pointd& center() const { return center_; }
  double radius() const { return radius_; }
  /// The largest coordinate, to rounding.
  double largest() const { return center_.lpNorm<Eigen::Infinity>() + radius_; }

 private:
  engine::MeshView<double> triangles_;  ///< without vertices if they are floats
  const Pointf* floats_ = nullptr;
  const engine::Tree* tree_ = nullptr;
  const Attachment* attachment_ = nullptr;
  Pointd center_ = Pointd::Zero();
  double radius_ = 0;
};

}  // namespace kios
