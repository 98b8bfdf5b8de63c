// SPDX-FileCopyrightText: 2026 The fcl_kios authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstddef>
#include <optional>
#include <vector>

#include "fcl_kios/search/counts.h"
#include "search/mesh_pair.h"
#include "search/pair_query.h"
#include "solid/solid_mark.h"

namespace kios {

/// Returns a triangle's unit normal; zero if it has none.
fcl::Vector3d normalOf(const TriangleVertices<double>& t);

/// Says how far apart two solids are after a translation of b.
struct Separation {
  bool apart = false;    ///< proven: the surfaces are disjoint, and neither solid is in the other
  double gap = 0;        ///< proven distance of the surfaces
  bool nearest = false;  ///< the following are set
  fcl::Vector3d on_a = fcl::Vector3d::Zero();  ///< nearest points, in the world, a as it is
  fcl::Vector3d on_b = fcl::Vector3d::Zero();
  fcl::Vector3d normal = fcl::Vector3d::Zero();  ///< unit, from a to b there
};

/// Holds two solids whose second is moved by translations in the world; or the first one, by their
/// opposites.
template <typename S>
class SolidPair {
 public:
  /// Throws std::invalid_argument if a model is no solid, or a pose not rigid.
  SolidPair(const Model<S>& a, const fcl::Transform3<S>& X_WA, const Model<S>& b,
            const fcl::Transform3<S>& X_WB, SearchCounts& counts, bool moves_a);

  /// Tests a translation. Nearest points are looked for up to `reach`.
  Separation test(const fcl::Vector3d& translation, double reach);
  /// Holds two triangles that meet, in a's frame.
  struct Contact {
    TriangleVertices<double> a, b;
  };
  /// Holds what meets after a translation of b.
  struct Overlap {
    std::vector<Contact> contacts;
    /// Where no surfaces meet, but one solid is in the other, or a component is: takes a vertex
    /// of it to the nearest wall, in a's frame.
    std::optional<fcl::Vector3d> to_wall;
    bool any() const { return to_wall || !contacts.empty(); }
  };
  Overlap overlapAfter(const fcl::Vector3d& translation, std::size_t limit);
  /// Returns what meets as the poses are; found once.
  const Overlap& overlap();
  int tests() const { return tests_; }
  const Model<S>& a() const { return a_; }
  const Model<S>& b() const { return b_; }
  const MeshPair& frame() const { return frame_; }
  const SolidState<S>& stateA() const { return state_a_; }
  const SolidState<S>& stateB() const { return state_b_; }
  /// Returns b's pose in a, in double.
  const fcl::Matrix3d& R_AB() const { return R_AB_; }
  const fcl::Vector3d& T_AB() const { return T_AB_; }
  const fcl::Matrix3d& R_WA() const { return R_WA_; }
  fcl::Vector3d inA(const fcl::Vector3d& p_W) const { return R_WA_.transpose() * (p_W - t_WA_); }
  /// Returns the sum of the radii of the root volumes.
  double size() const { return size_; }
  /// Bounds what rounding may do to a distance about this pose.
  double rounding() const { return rounding_; }
  SearchCounts& counts() { return counts_; }
  bool movesA() const { return moves_a_; }

 private:
  MeshPair moved(const fcl::Vector3d& translation) const;

  const Model<S>&a_, &b_;
  const fcl::Transform3d X_WA_, X_WB_;
  SearchCounts& counts_;
  const bool moves_a_;
  const double squared_errors_;  ///< see RelativePose
  const MeshPair frame_;
  const SolidState<S>&state_a_, &state_b_;
  const fcl::Matrix3d R_WA_;
  const fcl::Vector3d t_WA_;
  fcl::Matrix3d R_AB_;
  fcl::Vector3d T_AB_;
  std::optional<Overlap> overlap_;
  double size_, rounding_;
  int tests_ = 0;
};

}  // namespace kios
