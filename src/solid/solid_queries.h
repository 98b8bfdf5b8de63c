// SPDX-FileCopyrightText: 2026 The fcl_kios authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstddef>

#include <fcl/narrowphase/collision_request.h>
#include <fcl/narrowphase/collision_result.h>
#include <fcl/narrowphase/distance_request.h>
#include <fcl/narrowphase/distance_result.h>
#include "fcl_kios/model/model.h"
#include "model/kios_model.h"
#include "shape/shape_solid.h"
#include "solid/solid_mark.h"

namespace kios {

/// True if both are marked meshes, or one is and the other a shape: the two meshes, or null where
/// there is none, each with its partner. Throws std::invalid_argument if a marked one is no solid
/// any more.
template <typename S>
bool solidPair(const Model<S>* mesh_a, const fcl::CollisionGeometry<S>* b, const Model<S>* mesh_b,
               const fcl::CollisionGeometry<S>* a) {
  if (mesh_a && mesh_b) {
    requireFinished(*mesh_a);
    requireFinished(*mesh_b);
    return areSolids(*mesh_a, *mesh_b);
  }
  const Model<S>* const mesh = mesh_a ? mesh_a : mesh_b;
  if (!mesh || !isShape(mesh_a ? *b : *a)) return false;
  requireFinished(*mesh);
  SolidMark<S>* const mark = markOf(*mesh);
  if (mark) mark->check(*mesh);
  return mark != nullptr;
}

/// Answer fcl::collide and fcl::distance of a marked model and `other`, another one or one of FCL's
/// nine shapes: as the queries of their surfaces do, but one that lies in the other, or a component
/// that does, is in contact with it. Its triangles' ids are -1; its normal and depth, if contacts
/// are wanted, are those of penetration(), or for a shape the shortest translation found that is
/// proven to part them. Distance is then 0, and with enable_signed_distance less that length at
/// every overlap: its nearest points are the ends of the separating translation, that of `other`
/// less which gives that of the model.
template <typename S>
std::size_t collideSolid(const Model<S>& model, const fcl::Transform3<S>& X_WM,
                         const fcl::CollisionGeometry<S>& other, const fcl::Transform3<S>& X_WO,
                         const fcl::CollisionRequest<S>& request, fcl::CollisionResult<S>& result);
template <typename S>
S distanceSolid(const Model<S>& model, const fcl::Transform3<S>& X_WM,
                const fcl::CollisionGeometry<S>& other, const fcl::Transform3<S>& X_WO,
                const fcl::DistanceRequest<S>& request, fcl::DistanceResult<S>& result);

}  // namespace kios
