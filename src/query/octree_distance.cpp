// SPDX-FileCopyrightText: 2026 The fcl_kios authors
// SPDX-License-Identifier: BSD-3-Clause
#include "fcl_kios/query/octree_queries.h"

#if FCL_HAVE_OCTOMAP
#include <algorithm>
#include <cmath>
#include <limits>

#include "model/walk.h"
#include "query/cell_tree.h"
#include "query/mesh_contacts.h"
#include "query/posed_solid.h"
#include "shape/triangle_shape.h"
#include "volume/instantiate.h"
#include "volume/rounding.h"

namespace kios {
namespace {

using Node = octomap::OcTreeNode;

/// A cell of an octree in its frame.
template <typename S>
struct OctreeCell {
  const Node* node;
  fcl::AABB<S> box;
};

/// The search for the nearest occupied cell and triangle, posed in the octree's frame.
template <typename S>
class OctreeDistance {
 public:
  OctreeDistance(const fcl::OcTree<S>& octree, const fcl::Transform3<S>& X_WO,
                 const Model<S>& model, const fcl::Transform3<S>& X_WM,
                 const fcl::DistanceRequest<S>& request, fcl::DistanceResult<S>& result,
                 SearchCounts& counts)
      : octree_(octree),
        model_(model),
        request_(request),
        result_(result),
        counts_(counts),
        posed_(rootCube(octree), X_WM, X_WO, model.getBV(0).bv) {}

  void run() {
    if (result_.min_distance < std::numeric_limits<S>::max()) {
      lowerTo(posed_.toUnits(result_.min_distance));
    }
    const OctreeCell<S> root = {octree_.getRoot(), octree_.getRootBV()};
    if (!root.node || !octree_.isNodeOccupied(root.node)) return;
    if (!(best_ > 0)) return;
    const auto skip = [this](const CellAndNode& pair) {
      return !(std::max(pair.bound, 0.0) < cull_distance_);
    };
    walkNearestFirst(bounded(root, 0), skip, [this](const CellAndNode& pair, const auto& add) {
      expand(pair, add);
      return !(best_ > 0);
    });
    if (nearest_id_ < 0) return;
    const S distance = posed_.fromUnits(best_);
    if (!(distance < result_.min_distance)) return;
    result_.update(distance, &octree_, &model_, 0, nearest_id_);
    // FCL's query cell id, from which OcTree::getNodeByQueryCellId() finds the node; update() would
    // cut it to an int.
    result_.b1 = nearest_cell_.node - octree_.getRoot();
    if (request_.enable_nearest_points) {
      result_.nearest_points[0] = posed_.toWorld(on_cell_);
      result_.nearest_points[1] = posed_.toWorld(on_triangle_);
    }
  }

 private:
  struct CellAndNode {
    OctreeCell<S> cell;
    int node;
    double bound;
  };

  void lowerTo(double distance) {
    best_ = distance;
    cull_distance_ =
        engine::cullDistance(distance, request_.rel_err, posed_.toUnits(request_.abs_err));
  }

  /// With a lower bound of the distance of a cell and a node of the mesh, signed.
  CellAndNode bounded(const OctreeCell<S>& cell, int node) const {
    ++counts_.volume_tests;
    const double unit = posed_.toUnits(0.5);
    Ball balls[kIOS<S>::kMaxSpheres];
    const int k = posed_.placeSpheres(model_.getBV(node).bv, balls);
    double best = -kInfinity;
    for (int i = 0; i < k; ++i) {
      const auto out = [&](double at, int c) {
        const double low = unit * double{cell.box.min_[c]}, high = unit * double{cell.box.max_[c]};
        return std::abs(at - (low + high)) - (high - low);
      };
      const double x = out(balls[i].x, 0), y = out(balls[i].y, 1), z = out(balls[i].z, 2);
      const double most = std::max({x, y, z});
      const auto square = [](double v) { return v > 0 ? v * v : 0; };
      const double apart = most > 0 ? std::sqrt(square(x) + square(y) + square(z)) : most;
      best = std::max(best, apart - balls[i].r);
    }
    return {cell, node, best};
  }

  /// By FCL's rule for a pair of which not both are leaves, the larger is divided.
  template <typename Add>
  void expand(const CellAndNode& pair, const Add& add) {
    const auto& node = model_.getBV(pair.node);
    if (octree_.nodeHasChildren(pair.cell.node) &&
        (node.isLeaf() || pair.cell.box.size() > node.bv.size())) {
      for (unsigned int i = 0; i < 8; ++i) {
        if (!octree_.nodeChildExists(pair.cell.node, i)) continue;
        OctreeCell<S> cell = {octree_.getNodeChild(pair.cell.node, i), {}};
        if (!octree_.isNodeOccupied(cell.node)) continue;
        fcl::computeChildBV(pair.cell.box, i, cell.box);
        add(bounded(cell, pair.node));
      }
    } else if (node.isLeaf()) {
      test(pair.cell, node.primitiveId());
    } else {
      add(bounded(pair.cell, node.leftChild()));
      add(bounded(pair.cell, node.rightChild()));
    }
  }

  void test(const OctreeCell<S>& cell, int id) {
    ++counts_.leaf_kernels;
    CenteredCell centered;
    centered.set(cell.box, posed_.toUnits(1));
    const shape::Triangle triangle = centered.relative(posed_.place(cornersOf(model_, id)));
    const auto d = shape::distance(centered.box, triangle, cull_distance_);
    if (!(d.distance < best_)) return;
    lowerTo(d.distance);
    nearest_id_ = id;
    nearest_cell_ = cell;
    on_cell_ = d.on_shape + centered.center;
    on_triangle_ = d.on_triangle + centered.center;
  }

  const fcl::OcTree<S>& octree_;
  const Model<S>& model_;
  const fcl::DistanceRequest<S>& request_;
  fcl::DistanceResult<S>& result_;
  SearchCounts& counts_;
  const PosedSolid<S> posed_;  // its solid is the root's cube
  double best_ = kInfinity, cull_distance_ = best_;
  int nearest_id_ = -1;
  OctreeCell<S> nearest_cell_;
  shape::Vec on_cell_, on_triangle_;
};

}  // namespace

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

KIOS_INSTANTIATE_FUNCTION(distanceOctree);

}  // namespace kios
#endif  // FCL_HAVE_OCTOMAP
