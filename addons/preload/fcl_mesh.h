// SPDX-FileCopyrightText: 2026 The fcl_kios authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstddef>

#include <fcl/geometry/bvh/BVH_model.h>
#include <fcl/math/bv/OBBRSS.h>
#include <fcl/math/bv/kIOS.h>
#include "preload/calls.h"

namespace kios::preload {

/// Holds a model's arrays as they lie: not owned.
struct Mesh {
  const Geometry* model = nullptr;
  const fcl::Vector3d* vertices = nullptr;
  const fcl::Triangle* triangles = nullptr;
  std::size_t num_vertices = 0, num_triangles = 0;

  bool operator==(const Mesh& o) const {
    return model == o.model && vertices == o.vertices && triangles == o.triangles &&
           num_vertices == o.num_vertices && num_triangles == o.num_triangles;
  }
  std::size_t vertexBytes() const { return num_vertices * sizeof(*vertices); }
  std::size_t triangleBytes() const { return num_triangles * sizeof(*triangles); }
  std::size_t bytes() const { return vertexBytes() + triangleBytes(); }
};

template <typename BV>
const fcl::BVHModel<BV>& modelOf(const Geometry& geometry) {
  return static_cast<const fcl::BVHModel<BV>&>(geometry);
}

/// Whether models over a volume have copies.
inline bool isServed(fcl::NODE_TYPE type) {
  return type == fcl::BV_OBB || type == fcl::BV_RSS || type == fcl::BV_kIOS ||
         type == fcl::BV_OBBRSS;
}

/// Returns ask(model) of a geometry of this type, which isServed(). As FCL does, it is believed.
template <typename Ask>
auto withModel(const Geometry& geometry, fcl::NODE_TYPE type, const Ask& ask) {
  switch (type) {
    case fcl::BV_OBB:
      return ask(modelOf<fcl::OBBd>(geometry));
    case fcl::BV_RSS:
      return ask(modelOf<fcl::RSSd>(geometry));
    case fcl::BV_kIOS:
      return ask(modelOf<fcl::kIOSd>(geometry));
    default:
      return ask(modelOf<fcl::OBBRSSd>(geometry));
  }
}

/// Finds the arrays of a finished mesh that counts as occupied; false for any other state, of which
/// FCL makes what it makes.
template <typename BV>
bool readMesh(const fcl::BVHModel<BV>& model, Mesh& mesh) {
  const bool finished = model.build_state == fcl::BVH_BUILD_STATE_PROCESSED ||
                        model.build_state == fcl::BVH_BUILD_STATE_UPDATED;
  if (!finished || model.num_tris <= 0 || model.num_vertices <= 0 || !model.vertices ||
      !model.tri_indices || model.getNumBVs() != 2 * model.num_tris - 1 || !model.isOccupied()) {
    return false;
  }
  mesh = {&model, model.vertices, model.tri_indices, static_cast<std::size_t>(model.num_vertices),
          static_cast<std::size_t>(model.num_tris)};
  return true;
}

}  // namespace kios::preload
