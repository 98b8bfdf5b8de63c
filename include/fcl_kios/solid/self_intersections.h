// SPDX-FileCopyrightText: 2026 The fcl_kios authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstddef>
#include <limits>
#include <vector>

#include "fcl_kios/model/model.h"
#include "fcl_kios/triangle/intersection.h"

namespace kios {

/// Two triangles of a mesh that meet other than in the vertices and edges that they share.
struct SelfIntersection {
  int triangle_a, triangle_b;  ///< of the model, a < b
  Meeting kind;
};

/// The first `limit` pairs of triangles of a mesh that meet other than in shared vertices and
/// edges, by ids. Vertices of equal coordinates are shared. Triangles without area are left out.
/// Exact for all finite coordinates. O(n log n) where few do. Safe from many threads. Throws
/// std::invalid_argument if the model is not a finished mesh.
template <typename S>
std::vector<SelfIntersection> selfIntersections(
    const Model<S>& model, std::size_t limit = std::numeric_limits<std::size_t>::max());

}  // namespace kios
