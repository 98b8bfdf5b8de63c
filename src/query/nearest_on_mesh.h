// SPDX-FileCopyrightText: 2026 The fcl_kios authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "search/mesh.h"
#include "triangle/point_distance.h"
#include "volume/rounding.h"

namespace kios {

/// The point of a mesh that is nearest to another, in the mesh's frame.
struct NearestOnMesh {
  double distance = kInfinity;  ///< to 16 eps of the diagonal of the box around p and the triangle
  double lower = 0;             ///< proven: no triangle is nearer
  Pointd point = Pointd::Zero();
  int triangle = -1;  ///< -1: no triangle is within the search's distance
};

/// Finds the triangle of the least computed distance, of equal ones the least index, of all that
/// are at most `within` away. So the answer depends neither on the search nor on `start`, a
/// triangle that is thought to be near, or -1. The coordinates of p may be at most 2^1000.
NearestOnMesh nearestOnMesh(const Mesh& mesh, const Pointd& p, double within, int start = -1);

/// Bounds the error of a computed distance, by which `lower` is less than it, or than `within`.
double nearestError(const Mesh& mesh, double distance);

}  // namespace kios
