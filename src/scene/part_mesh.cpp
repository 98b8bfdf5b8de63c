// SPDX-FileCopyrightText: 2026 The fcl_kios authors
// SPDX-License-Identifier: BSD-3-Clause
#include "scene/part_mesh.h"

#include <vector>

#include <fcl/geometry/geometric_shape_to_BVH_model.h>
#include "fcl_kios/scene.h"
#include "fcl_kios/solids.h"
#include "model/kios_model.h"
#include "shape/visit_shape.h"
#include "solid/solid_mark.h"
#include "volume/errors.h"

namespace kios::scene {
namespace {

std::shared_ptr<Modeld> facesOf(const fcl::Boxd& box) {
  auto mesh = std::make_shared<Modeld>();
  requireBuilt(fcl::generateBVHModel(*mesh, box, fcl::Transform3d::Identity()));
  return mesh;
}

/// A face as a fan.
std::shared_ptr<Modeld> facesOf(const fcl::Convexd& convex) {
  std::vector<fcl::Triangle> triangles;
  const int* face = convex.getFaces().data();
  for (int i = 0; i < convex.getFaceCount(); face += *face + 1, ++i) {
    for (int k = 2; k < *face; ++k) triangles.emplace_back(face[1], face[k], face[k + 1]);
  }
  return makeModel(convex.getVertices(), triangles);
}

}  // namespace

std::shared_ptr<const Modeld> meshOfPart(
    const std::shared_ptr<const fcl::CollisionGeometryd>& geometry) {
  if (const Modeld* const model = asModel(geometry.get())) return {geometry, model};
  std::shared_ptr<Modeld> mesh;
  visitShape(
      *geometry, [&](const fcl::Boxd& box) { mesh = facesOf(box); },
      [&](const fcl::Convexd& convex) { mesh = facesOf(convex); }, [](const auto&) {});
  if (!mesh) {
    refuse(
        "a ", typeName(*geometry), " is no part; ",
        geometry->getObjectType() == fcl::OT_BVH
            ? "kios::toKIOS() makes a mesh over k-IOS of it."
            : "fcl::generateBVHModel() makes a mesh over k-IOS of a sphere, ellipsoid, cylinder or "
              "cone, kios::makeModel() of triangles, and kios::markSolid() a solid of it.");
  }
  markSolid(*mesh);
  return mesh;
}

}  // namespace kios::scene

namespace kios {

std::shared_ptr<Modeld> toDouble(const Modelf& model) {
  requireFinished(model);
  std::vector<fcl::Vector3d> vertices;
  vertices.reserve(static_cast<std::size_t>(model.num_vertices));
  for (int i = 0; i < model.num_vertices; ++i) {
    vertices.emplace_back(model.vertices[i].cast<double>());
  }
  auto mesh = makeModel(vertices, {model.tri_indices, model.tri_indices + model.num_tris});
  if (markOf(model)) markSolid(*mesh);
  return mesh;
}

}  // namespace kios
