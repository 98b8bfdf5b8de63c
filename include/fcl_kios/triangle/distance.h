// SPDX-FileCopyrightText: 2026 The fcl_kios authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "fcl_kios/triangle/triangle.h"

namespace kios {

/// Names a part of a triangle: a vertex, an edge (from its vertex to the next) or the face.
enum class TriangleFeature { kVertex0, kVertex1, kVertex2, kEdge0, kEdge1, kEdge2, kFace };

/// Distance of two triangles, with nearest points in their frame.
template <typename S>
struct TriangleDistance {
  S distance;                            ///< 0 if and only if the closed triangles intersect
  Point<S> point_a, point_b;             ///< on the triangles, |point_a - point_b| = distance
  TriangleFeature feature_a, feature_b;  ///< where the points lie; at distance 0 a common
                                         ///< vertex, or the faces
};
using TriangleDistanced = TriangleDistance<double>;
using TriangleDistancef = TriangleDistance<float>;

/// Finds the distance of two triangles in one frame. |d - d_exact| <= 16 eps L for every finite
/// input from 1e-300 to 1e300 (double; float likewise) and every degeneracy, L the extent of the
/// pair, eps the machine epsilon of S. Bitwise the same for all vertex orders and swapped
/// arguments.
///
/// A fast candidate is returned only if a slab between the triangles certifies it (duality gap);
/// the other pairs get exact predicates for 0 and a robust evaluation of the pairs of features that
/// may be the nearest.
template <typename S>
TriangleDistance<S> triangleDistance(const TriangleVertices<S>& a, const TriangleVertices<S>& b);

}  // namespace kios
