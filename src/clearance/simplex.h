// SPDX-FileCopyrightText: 2026 The fcl_kios authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <array>

#include <fcl/common/types.h>

namespace kios::exact {

/// Up to four differences z = y - x of points x of a and y of b, as in the algorithm of Gilbert,
/// Johnson and Keerthi. Their convex hull is part of the set of all differences, which contains the
/// origin if and only if the bodies meet.
class Simplex {
 public:
  /// Drops what does not hold the nearest point first; a full simplex around the origin stays.
  void add(const fcl::Vector3d& x, const fcl::Vector3d& y);

  /// The point of the hull nearest to the origin is q - p, with p in a and q in b.
  const fcl::Vector3d& p() const { return p_; }
  const fcl::Vector3d& q() const { return q_; }

 private:
  struct Point {
    fcl::Vector3d x, y;
    double weight;
  };
  void findNearest();

  int size_ = 0;
  std::array<Point, 4> point_;
  fcl::Vector3d p_ = fcl::Vector3d::Zero(), q_ = fcl::Vector3d::Zero();
};

}  // namespace kios::exact
