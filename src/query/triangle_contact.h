// SPDX-FileCopyrightText: 2026 The fcl_kios authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstddef>

#include "fcl_kios/triangle/triangle.h"

namespace kios {

/// The contact that FCL reports for two triangles that intersect, in their common frame.
template <typename S>
struct TriangleContact {
  Point<S> points[2];
  std::size_t num_points;  ///< 1 or 2
  Point<S> normal;         ///< unit, from the first triangle to the second as FCL orients it
  S depth;
};

/// The deepest vertices of one triangle below the other's plane, that plane's normal and their
/// depth, as FCL's routine gives them; where it gives none, or a triangle has no normal, a point of
/// the intersection, the other triangle's normal (x if neither has one) and depth 0. The triangles
/// must intersect.
template <typename S>
TriangleContact<S> triangleContact(const TriangleVertices<S>& a, const TriangleVertices<S>& b);

}  // namespace kios
