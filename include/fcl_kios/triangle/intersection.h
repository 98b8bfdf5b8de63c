// SPDX-FileCopyrightText: 2026 The fcl_kios authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "fcl_kios/triangle/triangle.h"

namespace kios {

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
