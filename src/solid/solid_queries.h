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

/// fcl::collide and fcl::distance of two marked models: as collideMeshes() and distanceMeshes(),
/// but one that lies in the other, or a component that does, is in contact with it. Its triangles'
/// ids are -1; its normal and depth, if contacts are wanted, are those of penetration(). Distance
/// is then 0, and with enable_signed_distance -penetration().upper at every overlap: its nearest
/// points are the ends of the separating translation, that of b less which gives that of a.
template <typename S>
std::size_t collideSolids(const Model<S>& a, const fcl::Transform3<S>& X_WA, const Model<S>& b,
                          const fcl::Transform3<S>& X_WB, const fcl::CollisionRequest<S>& request,
                          fcl::CollisionResult<S>& result);
template <typename S>
S distanceSolids(const Model<S>& a, const fcl::Transform3<S>& X_WA, const Model<S>& b,
                 const fcl::Transform3<S>& X_WB, const fcl::DistanceRequest<S>& request,
                 fcl::DistanceResult<S>& result);

/// Answers the same for a marked model and one of FCL's nine shapes. The translation is the
/// shortest found, and proven to part them.
template <typename S>
std::size_t collideSolidShape(const Model<S>& model, const fcl::Transform3<S>& X_WM,
                              const fcl::CollisionGeometry<S>& shape,
                              const fcl::Transform3<S>& X_WS,
                              const fcl::CollisionRequest<S>& request,
                              fcl::CollisionResult<S>& result);
template <typename S>
S distanceSolidShape(const Model<S>& model, const fcl::Transform3<S>& X_WM,
                     const fcl::CollisionGeometry<S>& shape, const fcl::Transform3<S>& X_WS,
                     const fcl::DistanceRequest<S>& request, fcl::DistanceResult<S>& result);

}  // namespace kios
