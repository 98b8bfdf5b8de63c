// SPDX-FileCopyrightText: 2026 The fcl_kios authors
// SPDX-License-Identifier: BSD-3-Clause
#include "fcl_kios/query/octree_queries.h"

#if FCL_HAVE_OCTOMAP
#include <algorithm>
#include <limits>
#include <vector>

#include "model/prepared.h"
#include "query/cell_tree.h"
#include "query/collide_with.h"
#include "query/posed_solid.h"
#include "search/cell_search.h"
#include "search/mesh_pair.h"
#include "search/search.h"
#include "shape/triangle_shape.h"
#include "volume/error_bounds.h"
#include "volume/instantiate.h"
#include "volume/rounding.h"

namespace kios {
namespace {

using engine::Cell;
using Node = octomap::OcTreeNode;

/// The cells and triangles of an octree and a mesh that meet. Everything is posed in the octree's
/// frame.
template <typename S>
class OctreeCollision final : engine::CellSide {
 public:
  OctreeCollision(const fcl::OcTree<S>& octree, const fcl::Transform3<S>& X_WO,
                  const Model<S>& model, const fcl::Transform3<S>& X_WM,
                  const fcl::CollisionRequest<S>& request, fcl::CollisionResult<S>& result,
                  SearchCounts& counts)
      : octree_(octree),
        model_(model),
        X_WO_(X_WO),
        X_WM_(X_WM),
        request_(request),
        result_(result),
        counts_(counts),
        posed_(rootCube(octree), X_WM, X_WO, model.getBV(0).bv),
        error_(cellError()),
        occupied_(model.isOccupied()),
        cells_(octree, posed_.solid().half.x(), request.enable_cost, occupied_),
        room_(request.enable_cost ? std::numeric_limits<std::size_t>::max()
                                  : request.num_max_contacts - result.numContacts()) {}

  void run() {
    if (model_.isFree() || !(request_.enable_cost || occupied_)) return;
    Ball spheres[kIOS<S>::kMaxSpheres];
    const int count = posed_.placeSpheres(model_.getBV(0).bv, spheres);
    ++counts_.volume_tests;
    start_ = cells_.cellsNear(spheres, count, error_);
    if (start_.empty()) return;
    if (!searchPrepared()) searchEach();
    report();
  }

 private:
  struct Found {
    Cell cell;
    int triangle;
  };

  /// How far the faces of cells near the mesh may lie from multiples of the unit. FCL's halve
  /// intervals: exactly, as long as these have an end at 0, and from then on at most 20 times at
  /// coordinates of at most twice the cell's. The root's size is rounded once.
  double cellError() const {
    const kIOS<S>& root = model_.getBV(0).bv;
    const double reach =
        posed_.toUnits(double{root.center0.template lpNorm<1>()} + 2 * double{root.radius0});
    const double largest = std::min(1.01 * reach + posed_.T().template lpNorm<Eigen::Infinity>(),
                                    posed_.solid().half.x());
    return 128 * error_bounds::kUlp<S> * largest;  // as a vector
  }

  // Pairs.

  std::uint32_t open(const void* node, std::uint32_t wanted, const void* (&children)[8],
                     std::uint32_t& leaves) override {
    return cells_.open(node, wanted, children, leaves);
  }

  bool evaluate(const Cell& cell, std::uint32_t triangle, bool sure) override {
    ++counts_.leaf_kernels;
    const int id = static_cast<int>(triangle);
    if (!sure) {
      setCell(cell);
      if (!shape::intersects(centered_.box, place(id))) return false;
    }
    found_.push_back({cell, id});
    return found_.size() >= room_;
  }

  void setCell(const Cell& cell) {
    if (cell.half == cell_.half && cell.x == cell_.x && cell.y == cell_.y && cell.z == cell_.z) {
      return;
    }
    cell_ = cell;
    aabb_ = cells_.boxAt(cell);
    centered_.set(aabb_, posed_.toUnits(1));
  }

  /// A triangle of the mesh relative to the centre of the cell that was set.
  shape::Triangle place(int id) const {
    return centered_.relative(posed_.place(cornersOf(model_, id)));
  }

  /// True if floats served.
  bool searchPrepared() {
    const engine::Tree& tree = treeOf(model_);
    engine::CellFrame frame;
    if (tree.exponent != 0 || !makeFrame(tree, frame)) return false;
    engine::kernels().cells({tree, frame, *this, counts_, start_.data(), start_.size()});
    return true;
  }

  /// Each triangle goes down the octree. True to end the search.
  bool searchBelow(const Cell& cell, int id) {
    if (cell.leaf != 0) return evaluate(cell, static_cast<std::uint32_t>(id), false);
    setCell(cell);
    shape::Solid grown = centered_.box;  // by more than rounding, as leaves decide
    grown.half.array() += error_ + 0x1p-40 * (grown.half + centered_.center.cwiseAbs()).sum();
    if (!shape::intersects(grown, place(id))) return false;
    const void* children[8];
    std::uint32_t leaves;
    const std::uint32_t mattering = open(cell.node, 0xFF, children, leaves);
    for (std::uint32_t i = 0; i < 8; ++i) {
      if ((mattering >> i & 1U) == 0) continue;
      if (searchBelow(cell.child(i, children[i], (leaves >> i & 1U) != 0), id)) return true;
    }
    return false;
  }
  void searchEach() {
    for (int id = 0; id < model_.num_tris; ++id) {
      for (const Cell& cell : start_) {
        if (searchBelow(cell, id)) return;
      }
    }
  }

  bool makeFrame(const engine::Tree& tree, engine::CellFrame& frame) const {
    const Eigen::Map<const Eigen::Vector3d> origin_M(tree.origin);
    const shape::Vec origin = cells_.origin();
    const shape::Vec t = posed_.R() * origin_M + (posed_.T() - origin);
    const double reach = tree.reach, scale = reach + t.template lpNorm<1>();
    const bool in_range = posed_.hasUnit1() && scale <= engine::CellFrame::kLargestReach &&
                          posed_.solid().half.x() <= engine::CellFrame::kLargestRoot;
    if (!in_range) return false;
    // The exact stage's points and boxes, and its tests.
    const double points = error_bounds::solidError(
        2 * (origin_M.template lpNorm<1>() + 2 * reach) + posed_.T().template lpNorm<1>() +
        std::min(posed_.solid().half.x(), 4 * (scale + origin.template lpNorm<1>())));
    const double more = posed_.stretch() * scale + points + error_;
    const double pad = 0x1p-18 * scale + more;
    for (int i = 0; i < 3; ++i) {
      for (int j = 0; j < 3; ++j) frame.from_mesh.R[i][j] = roundedTo<float>(posed_.R()(i, j));
      frame.from_mesh.t[i] = roundedTo<float>(t[i]);
    }
    frame.unit = roundedTo<float>(cells_.unit());
    frame.pad = roundUpFloat(pad);
    frame.box_pad = roundUpFloat(0x1p-17 * scale + more);
    return true;
  }

  // Results.

  /// A list of all that touch has one order, whichever tree was searched: by triangles, then cells.
  void sort() {
    std::sort(found_.begin(), found_.end(), [](const Found& a, const Found& b) {
      if (a.triangle != b.triangle) return a.triangle < b.triangle;
      if (a.cell.x != b.cell.x) return a.cell.x < b.cell.x;
      return a.cell.y != b.cell.y ? a.cell.y < b.cell.y : a.cell.z < b.cell.z;
    });
  }

  void report() {
    if (found_.size() < room_) sort();
    for (const Found& found : found_) {
      if (request_.enable_contact || request_.enable_cost) setCell(found.cell);
      const auto* const node = static_cast<const Node*>(found.cell.node);
      const bool occupied = node && octree_.isNodeOccupied(node) && occupied_;
      if (occupied && result_.numContacts() < request_.num_max_contacts) {
        addContact(node, found.triangle);
      }
      if (request_.enable_cost) addCost(node, found.triangle);
    }
  }

  void addContact(const Node* node, int id) {
    fcl::Contact<S> contact(&octree_, &model_, 0, id, fcl::Vector3<S>::Zero(),
                            fcl::Vector3<S>::Zero(), S(0));
    // FCL's query cell id, from which OcTree::getNodeByQueryCellId() finds the node; the
    // constructor would cut it to an int.
    contact.b1 = node - octree_.getRoot();
    if (request_.enable_contact) {
      const shape::TriangleShapeContact c = shape::contact(centered_.box, place(id));
      contact.pos = posed_.toWorld(c.position + centered_.center);
      contact.normal = posed_.directionToWorld(c.normal);  // from the cell to the mesh
      contact.penetration_depth = posed_.fromUnits(c.depth);
    }
    result_.addContact(contact);
  }

  void addCost(const Node* node, int id) {
    fcl::AABB<S> cell_box, shared;
    const fcl::Vector3<S> middle = X_WO_ * aabb_.center();
    const fcl::Vector3<S> half = X_WO_.linear().cwiseAbs() * (S(0.5) * (aabb_.max_ - aabb_.min_));
    cell_box.min_ = middle - half;
    cell_box.max_ = middle + half;
    const auto t = transformed(cornersOf(model_, id), X_WM_);
    cell_box.overlap(fcl::AABB<S>(t[0], t[1], t[2]), shared);
    const S occupancy = node ? S(node->getOccupancy()) : octree_.getOccupancyThres();
    result_.addCostSource(fcl::CostSource<S>(shared, occupancy * model_.cost_density),
                          request_.num_max_cost_sources);
  }

  const fcl::OcTree<S>& octree_;
  const Model<S>& model_;
  const fcl::Transform3<S>&X_WO_, &X_WM_;
  const fcl::CollisionRequest<S>& request_;
  fcl::CollisionResult<S>& result_;
  SearchCounts& counts_;
  const PosedSolid<S> posed_;  // its solid is the root's cube
  const double error_;
  const bool occupied_;
  CellTree<S> cells_;
  const std::size_t room_;  // for pairs
  std::vector<Cell> start_;
  std::vector<Found> found_;

  // The cell that was set last, in FCL's units and in those of the query.
  Cell cell_ = {nullptr, 0, 0, 0, 0, 0};
  fcl::AABB<S> aabb_;
  CenteredCell centered_;
};

}  // namespace

// Contacts come in an order that the model, the octree and the poses determine.
template <typename S>
std::size_t collideOctree(const fcl::OcTree<S>& octree, const fcl::Transform3<S>& X_WO,
                          const Model<S>& model, const fcl::Transform3<S>& X_WM,
                          const fcl::CollisionRequest<S>& request, fcl::CollisionResult<S>& result,
                          SearchCounts* counts) {
  const auto search = [&](const fcl::CollisionRequest<S>& asked) {
    SearchCounts unused;
    OctreeCollision<S> of(octree, X_WO, model, X_WM, asked, result, counts ? *counts : unused);
    if (asked.isSatisfied(result)) return false;
    of.run();
    return true;
  };
  return collideWith<S>(model, X_WM, octree, X_WO, request, result, search);
}

KIOS_INSTANTIATE_FUNCTION(collideOctree);

}  // namespace kios
#endif  // FCL_HAVE_OCTOMAP
