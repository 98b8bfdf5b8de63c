// SPDX-FileCopyrightText: 2026 The fcl_kios authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "fcl_kios/triangle/distance.h"

namespace kios {

/// Return triangleDistance(), bit for bit, of triangles that are known not to intersect, and of
/// some that are known to: their common point.
template <typename S>
TriangleDistance<S> disjointDistance(const TriangleVertices<S>& a, const TriangleVertices<S>& b);
template <typename S>
TriangleDistance<S> touchingDistance(const TriangleVertices<S>& a, const TriangleVertices<S>& b);

}  // namespace kios
