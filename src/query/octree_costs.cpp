// SPDX-FileCopyrightText: 2026 The fcl_kios authors
// SPDX-License-Identifier: BSD-3-Clause
#include "query/octree_costs.h"

#if FCL_HAVE_OCTOMAP
#include <algorithm>
#include <cstdint>
#include <iterator>
#include <limits>
#include <set>

#include <fcl/geometry/shape/utility.h>
#include "query/cell_tree.h"
#include "volume/instantiate.h"

namespace kios {
namespace {

/// A box among the cells of an octree, tested as FCL's routine for two boxes does: by 15 axes, of
/// which those across two edges have an allowance for parallel ones.
template <typename S>
class BoxAmongCells {
 public:
  BoxAmongCells(const fcl::Box<S>& box, const fcl::Transform3<S>& X_WB,
                const fcl::Transform3<S>& X_WO)
      : half_(0.5 * box.side.template cast<double>()) {
    const Eigen::Matrix3d R_OW = X_WO.linear().transpose().template cast<double>();
    R_ = R_OW * X_WB.linear().template cast<double>();
    center_ = R_OW * (X_WB.translation() - X_WO.translation()).template cast<double>();
    const Eigen::Matrix3d Q = R_.cwiseAbs();
    along_cell_ = Q * half_;
    cell_along_box_ = Q.colwise().sum();
    const double more =
        10 * double{std::numeric_limits<S>::epsilon()} * std::max(half_.maxCoeff(), 1.0);
    const Eigen::Matrix3d P = Q.array() + more;
    for (int i = 0; i < 3; ++i) {
      for (int j = 0; j < 3; ++j) {
        const int i1 = (i + 1) % 3, i2 = (i + 2) % 3, j1 = (j + 1) % 3, j2 = (j + 2) % 3;
        cell_across_(i, j) = P(i1, j) + P(i2, j);
        box_across_(i, j) = half_[j1] * P(i, j2) + half_[j2] * P(i, j1);
      }
    }
  }

  bool touches(const Eigen::Vector3d& cell, double h) const {
    const Eigen::Vector3d d = center_ - cell;
    if (((d.cwiseAbs() - along_cell_).array() > h).any()) return false;
    const Eigen::Vector3d e = R_.transpose() * d;
    if (((e.cwiseAbs() - half_ - h * cell_along_box_).array() > 0).any()) return false;
    for (int i = 0; i < 3; ++i) {
      const int i1 = (i + 1) % 3, i2 = (i + 2) % 3;
      const Eigen::Array3d apart = (d[i2] * R_.row(i1) - d[i1] * R_.row(i2)).array().abs();
      const Eigen::Array3d both = h * cell_across_.row(i) + box_across_.row(i);
      if ((apart > both).any()) return false;
    }
    return true;
  }

 private:
  const Eigen::Vector3d half_;
  Eigen::Vector3d center_, along_cell_, cell_along_box_;
  Eigen::Matrix3d R_, cell_across_, box_across_;
};

template <typename S>
class UnknownCells {
 public:
  UnknownCells(const fcl::OcTree<S>& octree, const fcl::Transform3<S>& X_WO, const fcl::Box<S>& box,
               const fcl::Transform3<S>& X_WB, S density, std::size_t most)
      : octree_(octree),
        cells_(octree, 0, true, false),
        X_WO_(X_WO),
        size_in_world_(X_WO.linear().cwiseAbs().rowwise().sum()),
        placed_(box, X_WB, X_WO),
        density_(density),
        most_(most) {
    computeBV(box, X_WB, box_);
    const S lengths = X_WO.translation().cwiseAbs().sum() + 4 * octree.getRootBV().max_[0] +
                      box_.min_.cwiseAbs().maxCoeff() + box_.max_.cwiseAbs().maxCoeff();
    rounding_ = 8 * std::numeric_limits<S>::epsilon() * lengths;
  }

  void run() {
    const auto* const root = octree_.getRoot();
    const bool known = root && (CellTree<S>::isLeaf(root) || !cells_.matters(root));
    if (!known) visit(root, octree_.getRootBV());
  }

  const std::set<fcl::CostSource<S>>& dearest() const { return dearest_; }

 private:
  /// A cell that is unknown, or may have unknown ones below.
  void visit(const void* node, const fcl::AABB<S>& cell) {
    const fcl::Vector3<S> center = cell.center();
    const S half = S(0.5) * (cell.max_[0] - cell.min_[0]);
    if (!mayBeDear(center, half)) return;
    if (!placed_.touches(center.template cast<double>(), half)) return;
    if (!node) return add(cell);
    const void* children[8];
    std::uint32_t leaves;
    std::uint32_t left = cells_.open(node, 0xFF, children, leaves);
    for (; left != 0; left &= left - 1) {
      const auto i = static_cast<unsigned int>(__builtin_ctz(left));
      if (children[i] && (leaves >> i & 1U) != 0) continue;  // known
      fcl::AABB<S> child;
      computeChildBV(cell, i, child);
      visit(children[i], child);
    }
  }

  /// False if no source of the cell, or below, is among the dearest: the overlap of its box in the
  /// world is too small. `rounding_` is for coordinates there.
  bool mayBeDear(const fcl::Vector3<S>& center, S half) const {
    if (dearest_.size() < most_ || !(density_ > 0)) return true;
    const fcl::Vector3<S> middle = X_WO_ * center, reach = half * size_in_world_;
    const fcl::Vector3<S> overlap =
        (middle + reach).cwiseMin(box_.max_) - (middle - reach).cwiseMax(box_.min_);
    const S volume = (overlap.array().max(S(0)) + rounding_).prod();
    return !(density_ * volume < dearest_.rbegin()->total_cost);
  }

  /// As FCL computes it.
  void add(const fcl::AABB<S>& cell) {
    fcl::Box<S> box;
    fcl::Transform3<S> X_WCell;
    constructBox(cell, X_WO_, box, X_WCell);
    fcl::AABB<S> in_world, shared;
    computeBV(box, X_WCell, in_world);
    in_world.overlap(box_, shared);
    dearest_.emplace(shared, density_);
    if (dearest_.size() > most_) dearest_.erase(std::prev(dearest_.end()));
  }

  const fcl::OcTree<S>& octree_;
  CellTree<S> cells_;
  const fcl::Transform3<S>& X_WO_;
  const fcl::Vector3<S> size_in_world_;  ///< of a cell, to be multiplied by its half size
  const BoxAmongCells<S> placed_;
  fcl::AABB<S> box_;  ///< in the world
  const S density_;
  const std::size_t most_;
  S rounding_;
  std::set<fcl::CostSource<S>> dearest_;
};

}  // namespace

template <typename S>
void addApproximateCost(const Model<S>& model, const fcl::Transform3<S>& X_WM,
                        const fcl::OcTree<S>& octree, const fcl::Transform3<S>& X_WO,
                        const fcl::CollisionRequest<S>& request, fcl::CollisionResult<S>& result) {
  if (model.isFree() || request.num_max_cost_sources == 0) return;
  fcl::Box<S> box;
  fcl::Transform3<S> X_WB;
  constructBox(model.getBV(0).bv, X_WM, box, X_WB);
  UnknownCells<S> cells(octree, X_WO, box, X_WB, octree.getOccupancyThres() * model.cost_density,
                        request.num_max_cost_sources);
  cells.run();
  for (const auto& source : cells.dearest()) {
    result.addCostSource(source, request.num_max_cost_sources);
  }
}

KIOS_INSTANTIATE_FUNCTION(addApproximateCost);

}  // namespace kios
#endif  // FCL_HAVE_OCTOMAP
