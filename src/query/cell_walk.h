// SPDX-FileCopyrightText: 2026 The fcl_kios authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <Eigen/Core>
#include <algorithm>
#include <cmath>
#include <cstdint>
#include <vector>

#include "fcl_kios/model/model.h"
#include "query/posed_solid.h"
#include "search/cell_search.h"
#include "volume/error_bounds.h"

namespace kios {

/// The search of search/cell_search.h in FCL's tree, for models that aren't prepared: the larger of
/// a cell and a node is divided, the caps of a node are four lanes. Real is float where lengths
/// allow that, as they do for CellFrame, else double.
///
/// Lengths are relative to the search's origin. With S = |centre|_1 + the node's reach instead of
/// that of a tree, and u of Real, the derivation in search/cell_search.h holds: offsets of caps are
/// stored in float, in units of a power of two, and R, the products and the sums cost 16 u S. The
/// pad, a length here and no coordinate, is 128 u S.
template <typename S, typename Real>
class CellWalk {
 public:
  /// `origin` and `unit` are those of cells, in units of `posed`; `error` is what is not in posed's
  /// own bounds. At most so many tests are made.
  CellWalk(const Model<S>& model, const PosedSolid<S>& posed, const Eigen::Vector3d& origin,
           double unit, double error, engine::CellSide& side, SearchCounts& counts,
           long long most_tests)
      : model_(model),
        posed_(posed),
        R_(posed.R().template cast<Real>()),
        origin_(origin),
        unit_(static_cast<Real>(unit)),
        error_(error),
        side_(side),
        counts_(counts),
        left_(most_tests) {}

  void run(const std::vector<engine::Cell>& start) {
    Spheres root;
    if (!place(0, root, [](const Spheres&) { return true; })) return;
    for (const engine::Cell& cell : start) {
      if (visit(cell, 0, root)) return;
    }
  }

  /// Negative if the search gave up.
  long long testsLeft() const { return left_; }

 private:
  using Four = Eigen::Array<Real, 4, 1>;
  static constexpr Real kMore = 1 + 0x1p-20F;

  /// Holds S0 and four caps of a node. All radii contain the pad.
  struct Spheres {
    Real x, y, z, r;
    Four cap_x, cap_y, cap_z, cap_r2;
  };
  struct Cube {
    Real x, y, z, half;
  };

  static Real square(Real from_middle, Real half) {
    const Real beyond = std::max(std::abs(from_middle) - half, Real(0));
    return beyond * beyond;
  }
  static Four square(const Four& from_middle, Real half) {
    const Four beyond = (from_middle.abs() - half).max(Real(0));
    return beyond * beyond;
  }

  Cube cubeOf(const engine::Cell& cell) const {
    return {unit_ * static_cast<Real>(cell.x), unit_ * static_cast<Real>(cell.y),
            unit_ * static_cast<Real>(cell.z),
            unit_ * static_cast<Real>(std::uint32_t{cell.half}) * kMore};
  }

  /// Places a node; its caps only if S0 is not enough to tell that it doesn't matter.
  template <class Matters>
  bool place(int id, Spheres& out, const Matters& matters) const {
    const kIOS<S>& bv = model_.getBV(id).bv;
    double lengths;
    const Ball s = posed_.placeCentral(bv, lengths);
    const double x = s.x - origin_.x(), y = s.y - origin_.y(), z = s.z - origin_.z();
    const double unit = scaled(posed_.toUnits(1), bv.exponent), reach = bv.reach * unit;
    constexpr double kPad = 128 * error_bounds::kUlp<Real>;
    const double pad = kPad * (std::abs(x) + std::abs(y) + std::abs(z) + reach) + error_;
    out.x = static_cast<Real>(x);
    out.y = static_cast<Real>(y);
    out.z = static_cast<Real>(z);
    out.r = static_cast<Real>(s.r + pad);
    if (!matters(out)) return false;
    using Floats = Eigen::Map<const Eigen::Array4f>;
    const auto of_unit = static_cast<Real>(unit);
    const Four o[3] = {Floats(bv.cap_x).template cast<Real>() * of_unit,
                       Floats(bv.cap_y).template cast<Real>() * of_unit,
                       Floats(bv.cap_z).template cast<Real>() * of_unit};
    const auto row = [&](int i, Real at) -> Four {
      return R_(i, 0) * o[0] + R_(i, 1) * o[1] + R_(i, 2) * o[2] + at;
    };
    out.cap_x = row(0, out.x);
    out.cap_y = row(1, out.y);
    out.cap_z = row(2, out.z);
    const auto more = static_cast<Real>(pad + error_bounds::solidError(lengths + 4 * reach) +
                                        posed_.stretch() * reach);
    const Four r = Floats(bv.cap_r).template cast<Real>() * of_unit + more;
    out.cap_r2 = r * r;
    return true;
  }

  /// Tells whether S0 alone proves the cube apart, and the next whether one of the caps does.
  static bool misses(const Cube& cube, const Spheres& s) {
    return square(s.x - cube.x, cube.half) + square(s.y - cube.y, cube.half) +
               square(s.z - cube.z, cube.half) >
           s.r * s.r;
  }
  static bool missesCap(const Cube& cube, const Spheres& s) {
    const Four sum = square(s.cap_x - cube.x, cube.half) + square(s.cap_y - cube.y, cube.half) +
                     square(s.cap_z - cube.z, cube.half);
    return (sum - s.cap_r2).maxCoeff() > 0;
  }

  bool charge(int tests) {
    counts_.volume_tests += tests;
    left_ -= tests;
    return left_ >= 0;
  }

  /// True to end the search.
  bool visit(const engine::Cell& cell, int id, const Spheres& spheres) {
    const auto& node = model_.getBV(id);
    const bool is_leaf = node.isLeaf();
    if (cell.leaf != 0 && is_leaf) {
      left_ -= 4;
      return side_.evaluate(cell, static_cast<std::uint32_t>(node.primitiveId()), false) ||
             left_ < 0;
    }
    const Cube cube = cubeOf(cell);
    constexpr Real kRadius = 1.75F;  // of a cube, in halves
    if (cell.leaf == 0 && (is_leaf || kRadius * cube.half > spheres.r)) {
      return openCell(cell, id, spheres);
    }
    for (const int child : {node.leftChild(), node.rightChild()}) {
      if (!charge(1)) return true;
      Spheres placed;
      const auto matters = [&](const Spheres& s) { return !misses(cube, s); };
      if (place(child, placed, matters) && !missesCap(cube, placed) && visit(cell, child, placed)) {
        return true;
      }
    }
    return false;
  }

  bool openCell(const engine::Cell& cell, int id, const Spheres& s) {
    if (!charge(4)) return true;
    const auto q = static_cast<std::int32_t>(cell.half / 2U);
    const auto at = [&](std::int32_t units) { return unit_ * static_cast<Real>(units); };
    const Real x[2] = {at(cell.x - q), at(cell.x + q)}, y[2] = {at(cell.y - q), at(cell.y + q)},
               z[2] = {at(cell.z - q), at(cell.z + q)}, half = at(q) * kMore;
    Real of_x[2], of_y[2], of_z[2];
    Four caps_x[2], caps_y[2], caps_z[2];
    for (int side = 0; side < 2; ++side) {
      of_x[side] = square(s.x - x[side], half);
      of_y[side] = square(s.y - y[side], half);
      of_z[side] = square(s.z - z[side], half);
      caps_x[side] = square(s.cap_x - x[side], half);
      caps_y[side] = square(s.cap_y - y[side], half);
      caps_z[side] = square(s.cap_z - z[side], half);
    }
    std::uint32_t near = 0;
    for (std::uint32_t i = 0; i < 8; ++i) {
      const std::uint32_t a = i & 1U, b = i >> 1U & 1U, c = i >> 2U;
      if (of_x[a] + of_y[b] + of_z[c] > s.r * s.r) continue;
      near |= std::uint32_t{!((caps_x[a] + caps_y[b] + caps_z[c] - s.cap_r2).maxCoeff() > 0)} << i;
    }
    if (near == 0) return false;
    const void* children[8];
    std::uint32_t leaves;
    near = side_.open(cell.node, near, children, leaves);
    // The child on the node's side of the middle first.
    const std::uint32_t side = std::uint32_t{s.x > at(cell.x)} |
                               std::uint32_t{s.y > at(cell.y)} << 1U |
                               std::uint32_t{s.z > at(cell.z)} << 2U;
    for (const std::uint32_t flip : {0U, 1U, 2U, 4U, 3U, 5U, 6U, 7U}) {
      const std::uint32_t i = side ^ flip;
      if ((near >> i & 1U) == 0) continue;
      if (visit(cell.child(i, children[i], (leaves >> i & 1U) != 0), id, s)) return true;
    }
    return false;
  }

  const Model<S>& model_;
  const PosedSolid<S>& posed_;
  const Eigen::Matrix<Real, 3, 3> R_;
  const Eigen::Vector3d origin_;
  const Real unit_;
  const double error_;
  engine::CellSide& side_;
  SearchCounts& counts_;
  long long left_;
};

}  // namespace kios
