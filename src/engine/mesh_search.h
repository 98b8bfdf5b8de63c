// SPDX-FileCopyrightText: 2026 The fcl_kios authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstddef>
#include <utility>
#include <vector>

#include "engine/mesh.h"
#include "engine/search.h"
#include "fcl_kios/bv/separation.h"
#include "fcl_kios/triangle/distance.h"

namespace kios::engine {

/// A mesh with its tree.
template <typename S>
struct PreparedMesh {
  const Tree& tree;
  MeshView<S> mesh;
};

/// Two meshes at a pose, in the frame of the first.
template <typename S>
struct PreparedPair {
  PreparedMesh<S> a, b;
  const RelativePose<S>& X_AB;
  FramePair frames;
  Audit* audit = nullptr;
};

/// Which distance is asked for.
template <typename S>
struct DistanceBounds {
  S at_most;  ///< only pairs nearer than this count
  S rel_err = 0, abs_err = 0;
};

/// A pair of triangles, by index; -1 if there is none.
struct TrianglePairIds {
  int a = -1, b = -1;

  bool operator<(const TrianglePairIds& o) const { return a != o.a ? a < o.a : b < o.b; }
};

/// The nearest triangles: d - d_exact <= max(rel_err * d_exact, abs_err), and 16 eps L where both
/// are 0. None if no pair is nearer than at_most. Of equally near pairs that with the least ids,
/// at distance 0 any.
template <typename S>
TrianglePairIds nearestTriangles(const PreparedPair<S>& pair, const DistanceBounds<S>& bounds,
                                 TriangleDistance<S>& nearest, SearchCounts& counts);

/// Up to `limit` pairs of triangles that intersect, all of them if there are no more; by ids.
template <typename S>
std::vector<TrianglePairIds> intersectingTriangles(const PreparedPair<S>& pair, std::size_t limit,
                                                   SearchCounts& counts);

}  // namespace kios::engine
