// SPDX-FileCopyrightText: 2026 The fcl_kios authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <string>

#include "fcl_kios/distance.h"
#include "inspection.h"

namespace kios::inspect {

/// "x,y,z" or "x,y,z,qw,qx,qy,qz" as the pose of a model in the world; the quaternion is
/// normalised. Throws std::invalid_argument unless there are 3 or 7 finite numbers, the
/// quaternion's length within 1 % of 1.
fcl::Transform3d parsePose(const std::string& text);

/// Holds the distance of two models at poses in the world, and its time.
struct PairQuery {
  fcl::Transform3d X_WA, X_WB;
  DistanceBracketResult<double> answer;
  int repeats = 0;
  double median_seconds = 0, min_seconds = 0;  ///< of the repeats: the trees are prepared
};

/// Asks `repeats` >= 1 times. Throws InputError where the library refuses the pair.
PairQuery queryPair(const Modeld& a, const fcl::Transform3d& X_WA, const Modeld& b,
                    const fcl::Transform3d& X_WB, int repeats);

}  // namespace kios::inspect
