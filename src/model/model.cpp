// SPDX-FileCopyrightText: 2026 The fcl_kios authors
// SPDX-License-Identifier: BSD-3-Clause
#include "fcl_kios/model.h"

#include <new>
#include <stdexcept>

#include <boost/core/demangle.hpp>
#include "build/mesh_view.h"
#include "model/kios_model.h"
#include "model/members.h"
#include "volume/errors.h"
#include "volume/instantiate.h"

namespace kios {
namespace {

std::string stateName(fcl::BVHBuildState state) {
  const auto left = [](const char* name, const char* end) {
    return std::string(name) + " (" + end +
           "() was not called, or failed: build it anew from beginModel(), until that returns 0)";
  };
  switch (state) {
    case fcl::BVH_BUILD_STATE_EMPTY:
      return "empty (beginModel() was not called, or only reset a full model: call it again)";
    case fcl::BVH_BUILD_STATE_BEGUN:
      return left("begun", "endModel");
    case fcl::BVH_BUILD_STATE_REPLACE_BEGUN:
      return left("being replaced", "endReplaceModel");
    case fcl::BVH_BUILD_STATE_UPDATE_BEGUN:
      return left("being updated", "endUpdateModel");
    default:
      return "finished";
  }
}

template <typename S>
void requireVertices(const fcl::Vector3<S>* vertices, std::size_t n) {
  for (std::size_t i = 0; i < n; ++i) {
    if (vertices[i].allFinite()) continue;
    refuse("vertex ", i, " (", vertices[i].transpose(), ") is not finite.");
  }
}

bool isFinished(fcl::BVHBuildState state, int num_tris, int num_bvs) {
  const bool processed =
      state == fcl::BVH_BUILD_STATE_PROCESSED || state == fcl::BVH_BUILD_STATE_UPDATED;
  return processed && num_tris > 0 && num_bvs == 2 * num_tris - 1;
}

// `what` ends before "it is ...".
[[noreturn]] void refuseUnfinished(const char* what, fcl::BVHBuildState state, int num_tris,
                                   int num_bvs, const char* remedy) {
  const bool processed =
      state == fcl::BVH_BUILD_STATE_PROCESSED || state == fcl::BVH_BUILD_STATE_UPDATED;
  if (!processed) refuse(what, ": it is ", stateName(state), ".");
  refuse(what, ": it has ", num_tris, " triangles but a tree of ", num_bvs,
         " nodes; geometry was added after it was built: ", remedy, ".");
}

}  // namespace

void requireIndices(const fcl::Triangle* triangles, std::size_t n, std::size_t num_vertices) {
  const engine::MeshView<double> mesh = {nullptr, num_vertices, triangles, n};
  for (std::size_t i = 0; i < n; ++i) {
    for (std::size_t k = 0; k < 3; ++k) {
      if (mesh.index(i, k) < num_vertices) continue;
      refuse("triangle ", i, " refers to vertex ", mesh.index(i, k), ", but there are ",
             num_vertices, ".");
    }
  }
}

void requireBuilt(int status) {
  if (status == fcl::BVH_ERR_MODEL_OUT_OF_MEMORY) throw std::bad_alloc();
  if (status != fcl::BVH_OK) refuse<std::logic_error>("FCL refused to build a new model.");
}

template <typename S>
std::string typeName(const fcl::CollisionGeometry<S>& geometry) {
  return boost::core::demangle(typeid(geometry).name());
}

template <typename S>
std::shared_ptr<Model<S>> makeModel(const std::vector<fcl::Vector3<S>>& vertices,
                                    const std::vector<fcl::Triangle>& triangles) {
  if (triangles.empty()) refuse("a model needs at least one triangle.");
  requireVertices(vertices.data(), vertices.size());
  requireIndices(triangles.data(), triangles.size(), vertices.size());
  auto model = std::make_shared<Model<S>>();
  requireBuilt(
      model->beginModel(static_cast<int>(triangles.size()), static_cast<int>(vertices.size())));
  requireBuilt(model->addSubModel(vertices, triangles));
  requireBuilt(model->endModel());
  requireFinished(*model);
  return model;
}

template <typename S>
std::shared_ptr<Model<S>> makePointCloud(const std::vector<fcl::Vector3<S>>& points) {
  if (points.empty()) refuse("a point cloud needs at least one point.");
  requireVertices(points.data(), points.size());
  auto model = std::make_shared<Model<S>>();
  requireBuilt(model->beginModel(0, static_cast<int>(points.size())));
  requireBuilt(model->addSubModel(points));
  requireBuilt(model->endModel());
  requireFinished(*model);
  return model;
}

template <typename S>
[[gnu::hot]] void requireFinished(const Model<S>& model) {
  if (isFinished(model.build_state, model.num_tris, model.getNumBVs())) return;
  refuseUnfinished("the BVHModel<kios::kIOS> can't be queried", model.build_state, model.num_tris,
                   model.getNumBVs(),
                   "build it anew, or refit it by beginUpdateModel(), updateSubModel() with all of "
                   "its vertices and endUpdateModel()");
}

void detail::requireConvertible(fcl::BVHBuildState state, int num_primitives, int num_bvs) {
  if (isFinished(state, num_primitives, num_bvs)) return;
  refuseUnfinished("the model can't be converted to k-IOS", state, num_primitives, num_bvs,
                   "build it anew from beginModel(), as FCL's refits write past their arrays");
}

template <typename S>
void validate(const Model<S>& model) {
  requireFinished(model);
  requireVertices(model.vertices, static_cast<std::size_t>(model.num_vertices));
  requireIndices(model.tri_indices, static_cast<std::size_t>(model.num_tris),
                 static_cast<std::size_t>(model.num_vertices));
}

KIOS_INSTANTIATE_FUNCTION(makeModel);
KIOS_INSTANTIATE_FUNCTION(makePointCloud);
KIOS_INSTANTIATE_FUNCTION(requireFinished);
KIOS_INSTANTIATE_FUNCTION(typeName);
KIOS_INSTANTIATE_FUNCTION(validate);

}  // namespace kios

template class fcl::BVHModel<kios::kIOS<double>>;
template class fcl::BVHModel<kios::kIOS<float>>;
