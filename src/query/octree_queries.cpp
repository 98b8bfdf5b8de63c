// SPDX-FileCopyrightText: 2026 The fcl_kios authors
// SPDX-License-Identifier: BSD-3-Clause
#include "fcl_kios/contact.h"

#if FCL_HAVE_OCTOMAP
#include <algorithm>
#include <limits>

#include "model/prepared.h"
#include "query/mesh_contacts.h"
#include "query/octree_search.h"
#include "volume/instantiate.h"
#include "volume/rounding.h"

namespace kios {
namespace {

/// FCL's query cell id, from which OcTree::getNodeByQueryCellId() finds the node. FCL's own
/// constructors and update() would cut it to an int.
template <typename S>
std::intptr_t cellId(const fcl::OcTree<S>& octree, const CellTree::Node* node) {
  return node - octree.getRoot();
}

/// The box around a cell in the world.
template <typename S>
fcl::AABB<S> boxInWorld(const OctreePair& pair, const engine::Cell& cell,
                        const fcl::Transform3<S>& X_WO) {
  const Pointd middle = pair.posed().toWorld(pair.cells().centerOf(cell));
  const Pointd half = X_WO.linear().template cast<double>().cwiseAbs().rowwise().sum() *
                      pair.posed().fromUnits(pair.cells().halfOf(cell));
  fcl::AABB<S> box;
  box.min_ = roundedTo<S>(middle - half);
  box.max_ = roundedTo<S>(middle + half);
  return box;
}

}  // namespace

// A pair that is not occupied on both sides matters for costs only. Contacts come in an order that
// the model, the octree and the poses determine.
template <typename S>
std::size_t collideOctree(const fcl::OcTree<S>& octree, const fcl::Transform3<S>& X_WO,
                          const Model<S>& model, const fcl::Transform3<S>& X_WM,
                          const fcl::CollisionRequest<S>& request, fcl::CollisionResult<S>& result,
                          SearchCounts* counts) {
  SearchCounts unused;
  const Mesh mesh = meshOf(model);
  if (wantsNothing(request.num_max_contacts)) return 0;
  const bool approximate = request.enable_cost && request.use_approximate_cost;
  const bool costs = request.enable_cost && !approximate, occupied = model.isOccupied();
  const auto matters = [&octree, costs, occupied](const CellTree::Node& node) {
    return !octree.isNodeFree(&node) && (costs || (octree.isNodeOccupied(&node) && occupied));
  };
  OctreeContacts pair(octree, X_WO, mesh, X_WM, costs, matters, counts ? *counts : unused);
  const auto room = [&] {
    return request.num_max_contacts - std::min(request.num_max_contacts, result.numContacts());
  };
  if (!costs && result.isCollision() && room() == 0) return result.numContacts();
  if (!model.isFree() && (costs || occupied)) {
    const auto& found = pair.run(costs ? std::numeric_limits<std::size_t>::max() : room());
    for (const OctreeContacts::Found& at : found) {
      const auto* const node = static_cast<const CellTree::Node*>(at.cell.node);
      const int id = static_cast<int>(at.triangle);
      if (node && occupied && octree.isNodeOccupied(node) && room() > 0) {
        fcl::Contact<S> contact(&octree, &model, 0, id, fcl::Vector3<S>::Zero(),
                                fcl::Vector3<S>::Zero(), S(0));
        contact.b1 = cellId(octree, node);
        if (request.enable_contact) {
          const shape::TriangleShapeContact c = pair.contactOf(at);
          contact.pos = roundedTo<S>(c.position);
          contact.normal = roundedTo<S>(c.normal);  // from the cell to the mesh
          contact.penetration_depth = roundedLength<S>(pair.posed().fromUnits(c.depth));
        }
        result.addContact(contact);
      }
      if (!costs) continue;
      fcl::AABB<S> shared;
      boxInWorld(pair, at.cell, X_WO).overlap(boxInWorld(model, id, X_WM), shared);
      const S occupancy = node ? S(node->getOccupancy()) : octree.getOccupancyThres();
      result.addCostSource(fcl::CostSource<S>(shared, occupancy * model.cost_density),
                           request.num_max_cost_sources);
    }
  }
  if (approximate) addApproximateCosts(model, X_WM, octree, X_WO, request, result);
  return result.numContacts();
}

template <typename S>
S distanceOctree(const fcl::OcTree<S>& octree, const fcl::Transform3<S>& X_WO,
                 const Model<S>& model, const fcl::Transform3<S>& X_WM,
                 const fcl::DistanceRequest<S>& request, fcl::DistanceResult<S>& result,
                 SearchCounts* counts) {
  requireErrorBounds(request);
  SearchCounts unused;
  const auto matters = [&](const CellTree::Node& node) { return octree.isNodeOccupied(&node); };
  OctreeDistance pair(octree, X_WO, meshOf(model), X_WM, false, matters, counts ? *counts : unused);
  if (request.isSatisfied(result)) return result.min_distance;
  const bool limited = result.min_distance < std::numeric_limits<S>::max();
  pair.run(request.rel_err, pair.posed().toUnits(request.abs_err),
           limited ? pair.posed().toUnits(result.min_distance) : kInfinity);
  if (pair.triangle() < 0) return result.min_distance;
  const S distance = roundedLength<S>(pair.posed().fromUnits(pair.distance()));
  if (!(distance < result.min_distance)) return result.min_distance;
  result.update(distance, &octree, &model, 0, pair.triangle());
  result.b1 = cellId(octree, pair.node());
  if (request.enable_nearest_points) {
    result.nearest_points[0] = roundedTo<S>(pair.posed().toWorld(pair.onCell()));
    result.nearest_points[1] = roundedTo<S>(pair.posed().toWorld(pair.onTriangle()));
  }
  return result.min_distance;
}

KIOS_INSTANTIATE_FUNCTION(collideOctree);
KIOS_INSTANTIATE_FUNCTION(distanceOctree);

}  // namespace kios
#endif  // FCL_HAVE_OCTOMAP
