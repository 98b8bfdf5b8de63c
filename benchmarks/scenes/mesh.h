// SPDX-FileCopyrightText: 2026 The fcl_kios authors
// SPDX-License-Identifier: BSD-3-Clause

#pragma once

#include <memory>
#include <stdexcept>
#include <string>
#include <utility>
#include <vector>

#include <Eigen/Geometry>

#include <fcl/geometry/bvh/BVH_model.h>
#include <fcl/math/triangle.h>

namespace kios::scenes {

/// Holds a triangle mesh in its own frame. Triangles index `vertices`; every index is in range.
struct Mesh {
  std::vector<fcl::Vector3d> vertices;
  std::vector<fcl::Triangle> triangles;
};

/// Returns the axis-aligned box of the vertices.
inline Eigen::AlignedBox3d boxOf(const Mesh& mesh) {
  Eigen::AlignedBox3d box;
  for (const fcl::Vector3d& p : mesh.vertices) box.extend(p);
  return box;
}

/// Returns the diagonal of the axis-aligned bounding box of the vertices; 0 for a mesh without
/// vertices.
inline double extent(const Mesh& mesh) {
  return mesh.vertices.empty() ? 0 : boxOf(mesh).sizes().norm();
}

/// Returns the triangles in their order, each with three vertices of its own (as PQP stores them).
inline Mesh soup(const Mesh& mesh) {
  Mesh result;
  result.vertices.reserve(3 * mesh.triangles.size());
  result.triangles.reserve(mesh.triangles.size());
  for (const fcl::Triangle& triangle : mesh.triangles) {
    const std::size_t first = result.vertices.size();
    for (int corner = 0; corner < 3; ++corner) {
      result.vertices.push_back(mesh.vertices[triangle[corner]]);
    }
    result.triangles.emplace_back(first, first + 1, first + 2);
  }
  return result;
}

/// Returns the mesh as an FCL model over any bounding volume, vertices cast to BV::S, its nodes
/// fitted by `fitter` if one is given. Throws std::runtime_error if FCL refuses the mesh (for
/// instance one without triangles).
template <typename BV>
std::shared_ptr<fcl::BVHModel<BV>> buildModel(
    const Mesh& mesh, std::shared_ptr<fcl::detail::BVFitterBase<BV>> fitter = nullptr) {
  std::vector<fcl::Vector3<typename BV::S>> vertices;
  vertices.reserve(mesh.vertices.size());
  for (const fcl::Vector3d& p : mesh.vertices) {
    vertices.push_back(p.template cast<typename BV::S>());
  }
  auto model = std::make_shared<fcl::BVHModel<BV>>();
  if (fitter) model->bv_fitter = std::move(fitter);
  int status = model->beginModel(static_cast<int>(mesh.triangles.size()),
                                 static_cast<int>(mesh.vertices.size()));
  if (status == fcl::BVH_OK) status = model->addSubModel(vertices, mesh.triangles);
  if (status == fcl::BVH_OK) status = model->endModel();
  if (status != fcl::BVH_OK) {
    throw std::runtime_error("FCL refused a mesh of " + std::to_string(mesh.triangles.size()) +
                             " triangles: BVHReturnCode " + std::to_string(status));
  }
  return model;
}

}  // namespace kios::scenes
