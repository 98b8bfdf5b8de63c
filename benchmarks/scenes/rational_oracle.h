// SPDX-FileCopyrightText: 2026 The fcl_kios authors
// SPDX-License-Identifier: BSD-3-Clause

#pragma once

#include <array>

#include <Eigen/Core>

#include "triangle_pair.h"

// Exact answers for two triangles of doubles, in integers of any size: the judge of the triangle
// kernels. Shares no formula with them: the verdict follows from the distance, not the reverse.

namespace kios::scenes {

struct RationalDistance {
  bool intersect;  ///< the closed triangles have a point in common
  long double
      distance;  ///< rounded once; neither under- nor overflows where it has 15 exponent bits
};

/// Is exact for all finite coordinates, denormals included, and for segments and points. The least
/// of all feasible pairs: vertices on edges, edges on edges, vertices on faces, and edges that
/// pierce a face. About 5 us times the pair's range of exponents in units of 100 bits.
RationalDistance rationalDistance(const TrianglePair& pair);

/// Returns that of a point and a triangle.
long double rationalDistance(const Eigen::Vector3d& point,
                             const std::array<Eigen::Vector3d, 3>& triangle);

}  // namespace kios::scenes
