// SPDX-FileCopyrightText: 2026 The fcl_kios authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstddef>

#include "fcl_kios/contact.h"
#include "model/kios_model.h"
#include "shape/shape_solid.h"
#include "solid/solid_mark.h"

namespace kios {

/// Returns true if both are marked meshes, or one is and the other a shape; `other_mesh` is `other`
/// if that is a mesh. Throws std::invalid_argument if a marked one is no solid any more.
template <typename S>
bool areSolids(const Model<S>& mesh, const fcl::CollisionGeometry<S>& other,
               const Model<S>* other_mesh) {
  requireFinished(mesh);
  if (other_mesh) {
    requireFinished(*other_mesh);
    return areSolids(mesh, *other_mesh);
  }
  const SolidState* const mark = isShape(other) ? markOf(mesh) : nullptr;
  if (mark) mark->check();
  return mark != nullptr;
}

/// Bounds the error of a mesh's distance from a shape, or where that is null from a mesh or a cell,
/// `length` the extent of both (docs/shapes.md).
double kernelError(const shape::Solid* shape, double length);

/// A mesh over k-IOS and another geometry, each at its pose: another mesh, one of FCL's nine shapes
/// or an octree. They are asked about as solids if they are solids, else as surfaces. Most pairs of
/// a scene take a few dozen instructions, so that what leads there is inlined.
template <typename S>
struct MeshAndOther {
  const Model<S>& mesh;
  const fcl::Transform3<S>& X_WM;
  const fcl::CollisionGeometry<S>& other;
  const fcl::Transform3<S>& X_WO;
  const Model<S>* other_mesh;  ///< `other` if it is a mesh

  /// Answer fcl::collide and fcl::distance. Results have FCL's order, whatever that of the call:
  /// mesh and shape, octree and mesh. Throw std::invalid_argument for what isn't served.
  [[gnu::always_inline]] std::size_t collide(const fcl::CollisionRequest<S>& request,
                                             fcl::CollisionResult<S>& result) const {
    return solids() ? collideSolids(request, result) : collideSurfaces(request, result);
  }
  S distance(const fcl::DistanceRequest<S>& request, fcl::DistanceResult<S>& result) const {
    return solids() ? distanceSolids(request, result) : distanceSurfaces(request, result);
  }
  /// Returns true if collide() finds a contact.
  bool touch() const {
    fcl::CollisionResult<S> result;
    return collide(fcl::CollisionRequest<S>(), result) > 0;
  }

  /// Answer as for surfaces, solids or not.
  [[gnu::always_inline]] std::size_t collideSurfaces(const fcl::CollisionRequest<S>& request,
                                                     fcl::CollisionResult<S>& result) const {
    if (other_mesh) return collideMeshes(mesh, X_WM, *other_mesh, X_WO, request, result);
    if (isShape(other)) return collideShape(mesh, X_WM, other, X_WO, request, result);
#if FCL_HAVE_OCTOMAP
    if (other.getObjectType() == fcl::OT_OCTREE) {
      return collideOctree(static_cast<const fcl::OcTree<S>&>(other), X_WO, mesh, X_WM, request,
                           result);
    }
#endif
    refusePair<S>("collide", mesh, other);
  }
  S distanceSurfaces(const fcl::DistanceRequest<S>& request, fcl::DistanceResult<S>& result,
                     SearchCounts* counts = nullptr) const {
    if (other_mesh) return distanceMeshes(mesh, X_WM, *other_mesh, X_WO, request, result, counts);
    if (isShape(other)) return distanceShape(mesh, X_WM, other, X_WO, request, result, counts);
#if FCL_HAVE_OCTOMAP
    if (other.getObjectType() == fcl::OT_OCTREE) {
      return distanceOctree(static_cast<const fcl::OcTree<S>&>(other), X_WO, mesh, X_WM, request,
                            result, counts);
    }
#endif
    refusePair<S>("distance", mesh, other);
  }

 private:
  bool solids() const {
    const bool marked = markOf(mesh) || (other_mesh && markOf(*other_mesh));
    return marked && areSolids(mesh, other, other_mesh);
  }
  /// Answer as the queries of their surfaces do, but one that lies in the other, or a component
  /// that does, is in contact with it. Its triangles' ids are -1; its normal and depth, if contacts
  /// are wanted, are those of penetration(), or for a shape the shortest translation found that is
  /// proven to part them. Distance is then 0, and with enable_signed_distance less that length at
  /// every overlap: its nearest points are the ends of the separating translation, that of `other`
  /// less which gives that of the mesh.
  std::size_t collideSolids(const fcl::CollisionRequest<S>& request,
                            fcl::CollisionResult<S>& result) const;
  S distanceSolids(const fcl::DistanceRequest<S>& request, fcl::DistanceResult<S>& result) const;
};

/// The pair of two geometries of which one at least is a mesh: a, if both are. Refers to all.
inline MeshAndOther<double> meshAndOther(const fcl::CollisionGeometryd& a,
                                         const fcl::Transform3d& X_WA,
                                         const fcl::CollisionGeometryd& b,
                                         const fcl::Transform3d& X_WB) {
  const Modeld *const mesh_a = asModel(&a), *const mesh_b = asModel(&b);
  if (mesh_a) return {*mesh_a, X_WA, b, X_WB, mesh_b};
  return {*mesh_b, X_WB, a, X_WA, nullptr};
}

}  // namespace kios
