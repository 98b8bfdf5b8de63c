// SPDX-FileCopyrightText: 2026 The fcl_kios authors
// SPDX-License-Identifier: BSD-3-Clause
#include "query/mesh_contacts.h"

#include <vector>

#include <fcl/geometry/shape/box.h>
#include "fcl_kios/detail/fcl_own.h"
#include "model/in_double.h"
#include "volume/instantiate.h"
#include "volume/rounding.h"

namespace kios {

// In double, as libfcl has no tables for float.
template <typename S>
void addApproximateCosts(const Model<S>& model, const fcl::Transform3<S>& X_WM,
                         const fcl::CollisionGeometry<S>& other, const fcl::Transform3<S>& X_WO,
                         const fcl::CollisionRequest<S>& request, fcl::CollisionResult<S>& result) {
  if (model.isFree()) return;  // FCL adds one of an empty octree even then
  const fcl::OBB<S> root = toOBB(model.getBV(0).bv, X_WM);
  fcl::Box<S> box(2 * root.extent);
  fcl::Transform3d X_WBox = fcl::Transform3d::Identity();
  X_WBox.linear() = root.axis.template cast<double>();
  X_WBox.translation() = root.To.template cast<double>();
  box.cost_density = model.cost_density;
  box.threshold_occupied = model.threshold_occupied;
  box.threshold_free = model.threshold_free;
  const auto box_d = inDouble(box), other_d = inDouble(other);
  fcl::CollisionResultd found;
  fcl_own::collide(
      box_d.get(), X_WBox, other_d.get(), fcl::Transform3d(X_WO.template cast<double>()),
      fcl::CollisionRequestd(1, false, request.num_max_cost_sources, true, false), found);
  std::vector<fcl::CostSourced> sources;
  found.getCostSources(sources);
  for (const fcl::CostSourced& source : sources) {
    fcl::AABB<S> shared;
    shared.min_ = roundedTo<S>(source.aabb_min);
    shared.max_ = roundedTo<S>(source.aabb_max);
    result.addCostSource(fcl::CostSource<S>(shared, roundedTo<S>(source.cost_density)),
                         request.num_max_cost_sources);
  }
}

KIOS_INSTANTIATE_FUNCTION(addApproximateCosts);

}  // namespace kios
