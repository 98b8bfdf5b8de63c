// SPDX-FileCopyrightText: 2026 The fcl_kios authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <Eigen/Core>
#include <array>
#include <utility>

#include "volume/lanes.h"

namespace kios {

/// Holds sums of the coordinates of points, relative to an origin of theirs, and of their products:
/// of one set, or of four sets, one a lane.
template <typename Real>
struct Scatter {
  Real x = {}, y = {}, z = {}, xx = {}, xy = {}, xz = {}, yy = {}, yz = {}, zz = {};

  void add(Real px, Real py, Real pz) {
    x += px;
    y += py;
    z += pz;
    xx += px * px;
    xy += px * py;
    xz += px * pz;
    yy += py * py;
    yz += py * pz;
    zz += pz * pz;
  }
  /// Makes the products those about the mean; `part` is 1 / n.
  void center(Real part) {
    xx -= part * x * x;
    xy -= part * x * y;
    xz -= part * x * z;
    yy -= part * y * y;
    yz -= part * y * z;
    zz -= part * z * z;
  }
};

/// Orthonormal axes of four frames: column k, coordinate r.
struct FourAxes {
  lanes::Float4 column[3][3];
};

/// Eigenvectors of the matrices of products in no order, by floats: true to about 1e-3 where the
/// eigenvalues differ by that. Any matrix gives axes that are orthonormal to 1e-6, also one that is
/// zero or not finite.
FourAxes principalAxes(const Scatter<lanes::Float4>& scatter);

/// Returns the axes by decreasing extent, of equal ones the first before.
template <typename Extents>
std::array<int, 3> longestFirst(const Extents& extents) {
  std::array<int, 3> order = {0, 1, 2};
  const auto sort = [&](int i, int j) {
    if (extents[order[i]] < extents[order[j]]) std::swap(order[i], order[j]);
  };
  sort(0, 1);
  sort(1, 2);
  sort(0, 1);
  return order;
}

/// Orthonormal axes, the first along a, the second towards b, each rounded once: a box's slabs add
/// up only if its axes are so. Either may be 0 or not finite, or parallel to the other.
Eigen::Matrix3f axesAlong(const Eigen::Vector3f& a, const Eigen::Vector3f& b);

/// A unit vector across each unit vector e.
void acrossAny(const lanes::Float4 (&e)[3], lanes::Float4 (&out)[3]);

}  // namespace kios
