// SPDX-FileCopyrightText: 2026 The fcl_kios authors
// SPDX-License-Identifier: BSD-3-Clause
#include "fcl_kios/query/octree_queries.h"

#if FCL_HAVE_OCTOMAP
#include <algorithm>
#include <cmath>
#include <limits>

#include "model/walk.h"
#include "query/collide_with.h"
#include "query/mesh_contacts.h"
#include "query/octree_collision.h"
#include "query/posed_solid.h"
#include "shape/triangle_shape.h"
#include "volume/instantiate.h"
#include "volume/rounding.h"

namespace kios {
namespace {

using Node = octomap::OcTreeNode;

/// A cell of an octree in its frame; `node` is null where the octree knows nothing.
template <typename S>
struct Cell {
  const Node* node;
  fcl::AABB<S> box;
};

/// An octree and a mesh posed in the octree's frame, with what collide and distance share.
template <typename S>
class OctreePair {
 public:
  OctreePair(const fcl::OcTree<S>& octree, const fcl::Transform3<S>& X_WO, const Model<S>& model,
             const fcl::Transform3<S>& X_WM, SearchCounts& counts)
      : octree_(octree),
        model_(model),
        counts_(counts),
        posed_(rootCube(octree), X_WM, X_WO, model.getBV(0).bv) {}

 protected:
  Cell<S> root() const { return {octree_.getRoot(), octree_.getRootBV()}; }

  bool isLeaf(const Cell<S>& cell) const {
    return !cell.node || !octree_.nodeHasChildren(cell.node);
  }

  /// A child that the octree lacks has no node.
  Cell<S> child(const Cell<S>& cell, unsigned int i) const {
    Cell<S> child = {nullptr, {}};
    fcl::computeChildBV(cell.box, i, child.box);
    if (octree_.nodeChildExists(cell.node, i)) child.node = octree_.getNodeChild(cell.node, i);
    return child;
  }

  /// FCL's rule for a pair of which not both are leaves: true if the cell is divided, not the node.
  bool dividesCell(const Cell<S>& cell, int node) const {
    const auto& bv = model_.getBV(node);
    return bv.isLeaf() || (!isLeaf(cell) && cell.box.size() > bv.bv.size());
  }

  /// The cell's box about the origin, and its centre, in units.
  shape::Solid boxOf(const fcl::AABB<S>& box, shape::Vec& center) const {
    const shape::Vec low = box.min_.template cast<double>(),
                     high = box.max_.template cast<double>();
    center = (0.5 * (low + high)) * posed_.toUnits(1);
    shape::Solid solid;
    solid.kind = shape::Kind::kBox;
    solid.half = (0.5 * (high - low)) * posed_.toUnits(1);
    return solid;
  }

  /// Lower bound of the distance of a cell and a node of the mesh, signed.
  double bound(const Cell<S>& cell, int node) const {
    ++counts_.volume_tests;
    shape::Vec center;
    const shape::Solid box = boxOf(cell.box, center);
    Ball balls[kIOS<S>::kMaxSpheres];
    const int k = posed_.placeSpheres(model_.getBV(node).bv, balls);
    double best = -kInfinity;
    for (int i = 0; i < k; ++i) {
      const shape::Vec c(balls[i].x, balls[i].y, balls[i].z);
      best = std::max(best, shape::pointBound(box, c - center) - balls[i].r);
    }
    return best;
  }

  /// A triangle of the mesh relative to a cell's centre.
  shape::Triangle place(int id, const shape::Vec& center) const {
    const shape::Triangle t = posed_.place(cornersOf(model_, id));
    return {t[0] - center, t[1] - center, t[2] - center};
  }

  /// FCL's query cell id, from which OcTree::getNodeByQueryCellId() finds the node.
  std::intptr_t idOf(const Cell<S>& cell) const { return cell.node - octree_.getRoot(); }

  const fcl::OcTree<S>& octree_;
  const Model<S>& model_;
  SearchCounts& counts_;
  const PosedSolid<S> posed_;  // its solid is the root's cube
};

template <typename S>
class OctreeDistance : OctreePair<S> {
 public:
  OctreeDistance(const fcl::OcTree<S>& octree, const fcl::Transform3<S>& X_WO,
                 const Model<S>& model, const fcl::Transform3<S>& X_WM,
                 const fcl::DistanceRequest<S>& request, fcl::DistanceResult<S>& result,
                 SearchCounts& counts)
      : OctreePair<S>(octree, X_WO, model, X_WM, counts), request_(request), result_(result) {}

  void run() {
    if (result_.min_distance < std::numeric_limits<S>::max()) {
      lowerTo(this->posed_.toUnits(result_.min_distance));
    }
    const Cell<S> root = this->root();
    if (!root.node || !this->octree_.isNodeOccupied(root.node)) return;
    if (!(best_ > 0)) return;
    const auto skip = [this](const CellAndNode& pair) {
      return !(std::max(pair.bound, 0.0) < cull_distance_);
    };
    walkNearestFirst(bounded(root, 0), skip, [this](const CellAndNode& pair, const auto& add) {
      expand(pair, add);
      return !(best_ > 0);
    });
    if (nearest_id_ < 0) return;
    const S distance = this->posed_.fromUnits(best_);
    if (!(distance < result_.min_distance)) return;
    result_.update(distance, &this->octree_, &this->model_, 0, nearest_id_);
    result_.b1 = this->idOf(nearest_cell_);  // update() would cut it to an int
    if (request_.enable_nearest_points) {
      result_.nearest_points[0] = this->posed_.toWorld(on_cell_);
      result_.nearest_points[1] = this->posed_.toWorld(on_triangle_);
    }
  }

 private:
  struct CellAndNode {
    Cell<S> cell;
    int node;
    double bound;
  };

  void lowerTo(double distance) {
    best_ = distance;
    cull_distance_ =
        engine::cullDistance(distance, request_.rel_err, this->posed_.toUnits(request_.abs_err));
  }

  CellAndNode bounded(const Cell<S>& cell, int node) const {
    return {cell, node, this->bound(cell, node)};
  }

  template <typename Add>
  void expand(const CellAndNode& pair, const Add& add) {
    const auto& node = this->model_.getBV(pair.node);
    const bool divides_cell = !this->isLeaf(pair.cell) && this->dividesCell(pair.cell, pair.node);
    if (divides_cell) {
      for (unsigned int i = 0; i < 8; ++i) {
        const Cell<S> cell = this->child(pair.cell, i);
        if (cell.node && this->octree_.isNodeOccupied(cell.node)) add(bounded(cell, pair.node));
      }
    } else if (node.isLeaf()) {
      test(pair.cell, node.primitiveId());
    } else {
      add(bounded(pair.cell, node.leftChild()));
      add(bounded(pair.cell, node.rightChild()));
    }
  }

  void test(const Cell<S>& cell, int id) {
    ++this->counts_.leaf_kernels;
    shape::Vec center;
    const shape::Solid box = this->boxOf(cell.box, center);
    const auto d = shape::distance(box, this->place(id, center), cull_distance_);
    if (!(d.distance < best_)) return;
    lowerTo(d.distance);
    nearest_id_ = id;
    nearest_cell_ = cell;
    on_cell_ = d.on_shape + center;
    on_triangle_ = d.on_triangle + center;
  }

  const fcl::DistanceRequest<S>& request_;
  fcl::DistanceResult<S>& result_;
  double best_ = kInfinity, cull_distance_ = best_;
  int nearest_id_ = -1;
  Cell<S> nearest_cell_ = {nullptr, {}};
  shape::Vec on_cell_, on_triangle_;
};

}  // namespace

template <typename S>
std::size_t collideOctree(const fcl::OcTree<S>& octree, const fcl::Transform3<S>& X_WO,
                          const Model<S>& model, const fcl::Transform3<S>& X_WM,
                          const fcl::CollisionRequest<S>& request, fcl::CollisionResult<S>& result,
                          SearchCounts* counts) {
  const fcl::CollisionGeometry<S>& other = octree;
  return collideWith(model, X_WM, other, X_WO, request, result, [&](const auto& asked) {
    SearchCounts unused;
    return addOctreeContacts(octree, X_WO, model, X_WM, asked, result, counts ? *counts : unused);
  });
}

template <typename S>
S distanceOctree(const fcl::OcTree<S>& octree, const fcl::Transform3<S>& X_WO,
                 const Model<S>& model, const fcl::Transform3<S>& X_WM,
                 const fcl::DistanceRequest<S>& request, fcl::DistanceResult<S>& result,
                 SearchCounts* counts) {
  requireErrorBounds(request);
  requireFinished(model);
  SearchCounts unused;
  OctreeDistance<S> search(octree, X_WO, model, X_WM, request, result, counts ? *counts : unused);
  if (!request.isSatisfied(result)) search.run();
  return result.min_distance;
}

KIOS_INSTANTIATE_FUNCTION(collideOctree);
KIOS_INSTANTIATE_FUNCTION(distanceOctree);

}  // namespace kios
#endif  // FCL_HAVE_OCTOMAP
