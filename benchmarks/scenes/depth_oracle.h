// SPDX-FileCopyrightText: 2026 The fcl_kios authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <array>
#include <vector>

#include <Eigen/Geometry>

#include "containment_oracle.h"
#include "random.h"

// Local depths (docs/solids.md) by samples, each of which is a lower bound: the judge of brackets.
// Sides are told by integers, distances by long doubles over all triangles.

namespace kios::scenes {

/// A solid as it lies in the world.
class DepthOracle {
 public:
  explicit DepthOracle(const Mesh& mesh);

  /// Returns the distance of the nearest triangle, walls within a union included; anything up to
  /// `enough` where it is at most that.
  double distance(const Eigen::Vector3d& p, double enough = -1) const;
  bool holds(const Eigen::Vector3d& p) const {
    return box.contains(p) && sides_.placeOf(p) == ContainmentOracle::Place::kInside;
  }
  /// Returns 0 outside, and wherever it is at most `enough`.
  double depth(const Eigen::Vector3d& p, double enough = 0) const;

  const Mesh mesh;
  Eigen::AlignedBox3d box;

 private:
  const ContainmentOracle sides_;
  std::vector<Eigen::AlignedBox3d> boxes_;  ///< around the triangles
};

/// Returns the depth of the deepest in b of points on a's triangles, (steps + 1) (steps + 2) / 2 of
/// each; walls within a are no surface.
double deepestSample(const DepthOracle& a, const DepthOracle& b, int steps);

/// Returns the radius of the largest of balls in both about points at random.
double largestBall(const DepthOracle& a, const DepthOracle& b, int count, Random& random);

/// Returns the depth that a point proves: in the other of the one on whose surface it lies but for
/// the tolerance, or of a ball in both.
double provenDepth(const DepthOracle& a, const DepthOracle& b, const Eigen::Vector3d& p,
                   double tolerance);

}  // namespace kios::scenes
