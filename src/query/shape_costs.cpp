// SPDX-FileCopyrightText: 2026 The fcl_kios authors
// SPDX-License-Identifier: BSD-3-Clause
#include "query/shape_costs.h"

#include <fcl/geometry/shape/utility.h>
#include <fcl/narrowphase/detail/primitive_shape_algorithm/halfspace.h>
#include <fcl/narrowphase/detail/primitive_shape_algorithm/plane.h>
#include "fcl_kios/fcl_own.h"
#include "volume/instantiate.h"

namespace kios {
namespace {

/// Calls f with the shape as what it is.
template <typename S, class F>
auto withShape(const fcl::CollisionGeometry<S>& shape, const F& f) {
  switch (shape.getNodeType()) {
    case fcl::GEOM_BOX:
      return f(static_cast<const fcl::Box<S>&>(shape));
    case fcl::GEOM_SPHERE:
      return f(static_cast<const fcl::Sphere<S>&>(shape));
    case fcl::GEOM_ELLIPSOID:
      return f(static_cast<const fcl::Ellipsoid<S>&>(shape));
    case fcl::GEOM_CAPSULE:
      return f(static_cast<const fcl::Capsule<S>&>(shape));
    case fcl::GEOM_CONE:
      return f(static_cast<const fcl::Cone<S>&>(shape));
    case fcl::GEOM_CYLINDER:
      return f(static_cast<const fcl::Cylinder<S>&>(shape));
    case fcl::GEOM_CONVEX:
      return f(static_cast<const fcl::Convex<S>&>(shape));
    case fcl::GEOM_HALFSPACE:
      return f(static_cast<const fcl::Halfspace<S>&>(shape));
    default:
      return f(static_cast<const fcl::Plane<S>&>(shape));
  }
}

template <typename S>
bool touch(const fcl::Box<S>& box, const fcl::Transform3<S>& X_WBox,
           const fcl::CollisionGeometry<S>& shape, const fcl::Transform3<S>& X_WS) {
  switch (shape.getNodeType()) {  // FCL's own query takes longer to get there
    case fcl::GEOM_HALFSPACE:
      return fcl::detail::boxHalfspaceIntersect(box, X_WBox,
                                                static_cast<const fcl::Halfspace<S>&>(shape), X_WS);
    case fcl::GEOM_PLANE:
      return fcl::detail::boxPlaneIntersect<S>(
          box, X_WBox, static_cast<const fcl::Plane<S>&>(shape), X_WS, nullptr);
    default:
      break;
  }
  const fcl::CollisionGeometry<S>* root = &box;
  fcl::CollisionResult<S> found;
  fcl_own::collide(root, X_WBox, &shape, X_WS, fcl::CollisionRequest<S>(1, false, 1, true, false),
                   found);
  return found.numCostSources() > 0;
}

}  // namespace

template <typename S>
void addApproximateCost(const Model<S>& model, const fcl::Transform3<S>& X_WM,
                        const fcl::CollisionGeometry<S>& shape, const fcl::Transform3<S>& X_WS,
                        bool triangle_touches, const fcl::CollisionRequest<S>& request,
                        fcl::CollisionResult<S>& result) {
  if (model.isFree() || shape.isFree() || request.num_max_cost_sources == 0) return;
  fcl::Box<S> box;
  fcl::Transform3<S> X_WBox;
  constructBox(model.getBV(0).bv, X_WM, box, X_WBox);
  box.cost_density = model.cost_density;
  box.threshold_occupied = model.threshold_occupied;
  box.threshold_free = model.threshold_free;
  if (!triangle_touches && !touch(box, X_WBox, shape, X_WS)) return;
  fcl::AABB<S> around_box, around_shape, shared;
  computeBV(box, X_WBox, around_box);
  withShape(shape, [&](const auto& s) { computeBV(s, X_WS, around_shape); });
  around_box.overlap(around_shape, shared);
  result.addCostSource(fcl::CostSource<S>(shared, model.cost_density * shape.cost_density),
                       request.num_max_cost_sources);
}

KIOS_INSTANTIATE_FUNCTION(addApproximateCost);

}  // namespace kios
