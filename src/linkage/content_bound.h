// SPDX-FileCopyrightText: 2026 The fcl_kios authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <vector>

#include <fcl/common/types.h>

namespace kios::articulated {

/// Two simple sets, each of which contains a body's whole content, in one frame: a ball, and a
/// capsule, which is much nearer to a long link. Radii are rounded up.
struct ContentBound {  // NOLINT(bugprone-reserved-identifier): in the copy of an array
  fcl::Vector3d center = fcl::Vector3d::Zero();
  double radius = 0;
  fcl::Vector3d ends[2] = {fcl::Vector3d::Zero(), fcl::Vector3d::Zero()};
  double capsule_radius = 0;

  /// >= |x| of every point x.
  double reach() const;
};

/// The bound of the hull of `points`, of which there is one at least, each grown by `margin`. The
/// ball is around `center`.
ContentBound boundOf(const std::vector<fcl::Vector3d>& points, double margin,
                     const fcl::Vector3d& center);

}  // namespace kios::articulated
