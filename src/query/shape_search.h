// SPDX-FileCopyrightText: 2026 The fcl_kios authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstddef>
#include <optional>
#include <vector>

#include "query/float_solid.h"
#include "search/search.h"
#include "search/solid_search.h"
#include "shape/convex_faces.h"
#include "shape/separating_slabs.h"
#include "shape/triangle_shape.h"

// The searches about a mesh and a solid: by the kernels, or triangle by triangle where floats don't
// serve. Everything is in the solid's frame and units.

namespace kios {

/// What both searches know of the pair, and the slabs of the solid that they find.
class SolidSearcher : public engine::SolidEvaluator {
 protected:
  SolidSearcher(const Mesh& mesh, const PosedSolid& posed, SearchCounts& counts)
      : mesh_(mesh), posed_(posed), counts_(counts), slabs_(posed.solid()) {}
  ~SolidSearcher() = default;

  /// See makeFloatSolid(). Floats may be asked for slabs thereafter.
  void makeFloats(bool any_slab) {
    floats_serve_ = makeFloatSolid(mesh_.tree(), posed_, any_slab, floats_);
  }
  void search();
  /// {n x <= offset} for the kernels.
  engine::FloatSlab inTree(const shape::Vec& n, double offset) const {
    return slabInTree(mesh_.tree(), posed_, n, offset);
  }
  shape::Triangle triangle(int id) const {
    return posed_.place(mesh_.triangle(static_cast<std::size_t>(id)));
  }

  const Mesh& mesh_;
  const PosedSolid& posed_;
  SearchCounts& counts_;
  shape::SeparatingSlabs slabs_;  ///< of a convex shape, as other bounds cost less than GJK
  bool floats_serve_ = false;

 private:
  engine::FloatSolid floats_;
};

/// Search for the triangle nearest to a solid: the least id of those whose computed distance is
/// bitwise the least. That does not depend on which are evaluated, and in which order, as long as
/// all are that may be as near: distances of single triangles are kept apart from the bounds that
/// leave others out by more than both are off.
class NearestTriangle final : SolidSearcher {
 public:
  NearestTriangle(const Mesh& mesh, const PosedSolid& posed, double rel_err, double abs_err,
                  double far_enough, SearchCounts& counts);

  void run() {
    makeFloats(/*any_slab=*/false);
    search();
  }

  int id() const { return id_; }  ///< -1 if none is nearer than far_enough
  const shape::TriangleShapeDistance& nearest() const { return nearest_; }

 private:
  bool evaluate(std::uint32_t triangle, bool meets) override;
  void lowerTo(double distance);

  const double rel_err_, abs_err_, slack_;
  double best_, limit_;
  int id_ = -1;
  shape::TriangleShapeDistance nearest_;
};

/// The vertex of a mesh that lies farthest along n, which is not zero: no other is farther by more
/// than 2^-47 |n| mesh.largest().
Pointd farthestVertex(const Mesh& mesh, const Pointd& n);

/// The triangles that meet a solid.
class TouchingTriangles final : SolidSearcher {
 public:
  TouchingTriangles(const Mesh& mesh, const PosedSolid& posed, std::size_t limit,
                    SearchCounts& counts)
      : SolidSearcher(mesh, posed, counts), limit_(limit) {}

  /// Up to `limit` triangles; by ids if these are all. Called once.
  const std::vector<int>& run();
  /// The contact of a triangle that was found.
  shape::TriangleShapeContact contactOf(int id);

 private:
  bool evaluate(std::uint32_t triangle, bool meets) override;
  bool facesPay() const;
  void setFaces();
  void sort();
  const shape::ConvexFaces& faces() {
    if (!faces_) faces_.emplace(posed_.solid());
    return *faces_;
  }

  const std::size_t limit_;
  bool by_faces_ = false;  ///< the search has the slabs of all faces
  std::optional<shape::ConvexFaces> faces_;
  int num_tests_ = 0;
  std::vector<int> found_;
};

}  // namespace kios
