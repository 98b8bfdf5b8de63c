// SPDX-FileCopyrightText: 2026 The fcl_kios authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <Eigen/Core>
#include <array>

namespace kios {

/// A point in space.
template <typename S>
using Point = Eigen::Matrix<S, 3, 1>;
using Pointd = Point<double>;
using Pointf = Point<float>;

/// A closed triangle by its vertices, in any order; it may degenerate to a segment or a point.
template <typename S>
using TriangleVertices = std::array<Point<S>, 3>;
using TriangleVerticesd = TriangleVertices<double>;
using TriangleVerticesf = TriangleVertices<float>;

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

/// Returns true if and only if the two closed triangles have a point in common: exact for every
/// finite input, coplanar, touching and degenerate (segments, points) ones included. Evaluated with
/// a static filter, numbers in two doubles behind it, and integers where those leave it open.
/// S = double or float; coordinates in one frame.
template <typename S>
bool trianglesIntersect(const TriangleVertices<S>& a, const TriangleVertices<S>& b);

/// Returns a point of the intersection of two triangles that intersect: the mean of the corners of
/// their common segment or polygon, each rounded. Error: about 8 eps times the extent of the pair
/// for crossing triangles, growing as they become parallel. Undefined if they don't intersect.
template <typename S>
Point<S> intersectionPoint(const TriangleVertices<S>& a, const TriangleVertices<S>& b);

/// How two triangles meet other than in vertices and edges that they share, by equal coordinates.
enum class Meeting {
  kNone,
  kTouch,   ///< a vertex on a face or an edge, edges that meet, a face that stands on another
  kCross,   ///< either passes through the other
  kOverlap  ///< they share an area of one plane: folded neighbours and equal triangles, too
};

/// Says how two triangles meet. Exact for all finite coordinates. A triangle without area meets
/// none.
Meeting meetingOf(const TriangleVerticesd& a, const TriangleVerticesd& b);

}  // namespace kios
