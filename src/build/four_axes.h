// SPDX-FileCopyrightText: 2026 The fcl_kios authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <Eigen/Core>

#include "volume/lanes.h"

namespace kios {

/// Four symmetric matrices, one a lane.
struct FourScatter {
  lanes::Float4 xx = {}, xy = {}, xz = {}, yy = {}, yz = {}, zz = {};
};

/// Orthonormal axes of four frames: column k, coordinate r.
struct FourAxes {
  lanes::Float4 column[3][3];
};

/// Eigenvectors of scatter matrices in no order, by floats: true to about 1e-3 where the
/// eigenvalues differ by that. Any matrix gives axes that are orthonormal to 1e-6, also one that is
/// zero or not finite.
FourAxes principalAxes(const FourScatter& scatter);

/// Holds one matrix.
struct Scatter {
  float xx = 0, xy = 0, xz = 0, yy = 0, yz = 0, zz = 0;
};
Eigen::Matrix3f principalAxes(const Scatter& scatter);

/// A unit vector across each unit vector e.
void acrossAny(const lanes::Float4 (&e)[3], lanes::Float4 (&out)[3]);

}  // namespace kios
