// SPDX-FileCopyrightText: 2026 The fcl_kios authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <memory>
#include <vector>

#include "fcl_kios/search/counts.h"
#include "query/mesh_pair.h"
#include "search/pair_query.h"
#include "solid/solid_mark.h"

namespace kios {

/// Holds two solids whose second is moved by translations in the world.
template <typename S>
class SolidPair {
 public:
  /// Throws std::invalid_argument if a model is no solid, or a pose not rigid.
  SolidPair(const Model<S>& a, const fcl::Transform3<S>& X_WA, const Model<S>& b,
            const fcl::Transform3<S>& X_WB, SearchCounts& counts);

  /// Holds the pair after a translation of b.
  struct Test {
    bool apart = false;    ///< proven: the surfaces are disjoint, and neither solid is in the other
    double gap = 0;        ///< proven distance of the surfaces
    bool nearest = false;  ///< the following are set
    fcl::Vector3d on_a = fcl::Vector3d::Zero();    ///< a nearest point, in the world
    fcl::Vector3d normal = fcl::Vector3d::Zero();  ///< unit, from a to b there
  };
  /// Tests `translation` as S rounds it. Nearest points are looked for up to `reach`.
  Test test(const fcl::Vector3d& translation, double reach);
  /// Returns true if test() would find no contact, but for distances of rounding; in less time.
  bool seemsApart(const fcl::Vector3d& translation);
  int tests() const { return tests_; }
  /// Returns how far b lies after one translation from where it lies after another: both as S
  /// rounds the poses. The result is right to 2^-50 of it.
  double wayBetween(const fcl::Vector3d& from, const fcl::Vector3d& to) const;

  /// Returns a direction in the world, unit, along which b's triangles may leave a's, by those that
  /// meet: the most promising first.
  std::vector<fcl::Vector3d> exitDirections();

  /// Holds points of a's frame where the surfaces meet, each with a direction into both solids;
  /// found by exitDirections().
  struct Seam {
    fcl::Vector3d point, inwards;
  };
  const std::vector<Seam>& seams() const { return seams_; }

  /// Returns translations in the world by which the centre of one passes the nearest wall of the
  /// other, and its radius too; found by exitDirections() if no surfaces meet.
  const std::vector<fcl::Vector3d>& walls() const { return walls_; }

  const MeshPair<S>& frame() const { return frame_; }
  const SolidState<S>& stateA() const { return *state_a_; }
  const SolidState<S>& stateB() const { return *state_b_; }
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

 private:
  MeshPair<S> moved(const fcl::Vector3d& translation) const;

  const fcl::Transform3<S>&X_WA_, &X_WB_;
  SearchCounts& counts_;
  const MeshPair<S> frame_;
  const std::shared_ptr<const SolidState<S>> state_a_, state_b_;
  const fcl::Matrix3d R_WA_;
  const fcl::Vector3d t_WA_;
  fcl::Matrix3d R_AB_;
  fcl::Vector3d T_AB_;
  std::vector<Seam> seams_;
  std::vector<fcl::Vector3d> walls_;
  double size_, rounding_;
  int tests_ = 0;
};

}  // namespace kios
