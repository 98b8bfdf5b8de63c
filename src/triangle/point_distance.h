// SPDX-FileCopyrightText: 2026 The fcl_kios authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "fcl_kios/triangle.h"

namespace kios {

/// The point of a closed triangle that is nearest to another.
struct NearestOnTriangle {
  double distance;  ///< 0 if and only if the other point lies on the triangle
  Pointd point;     ///< on the triangle, to a few roundings of its coordinates
};

/// Finds it for any finite p and triangle, degenerate ones too. |d - d_exact| <= 16 eps L, L the
/// diagonal of the box around p and the triangle, as of triangleDistance(), to which all goes that
/// plain arithmetic can't certify.
NearestOnTriangle nearestOnTriangle(const Pointd& p, const TriangleVerticesd& t);

}  // namespace kios
