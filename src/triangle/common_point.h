// SPDX-FileCopyrightText: 2026 The fcl_kios authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "fcl_kios/triangle/triangle.h"

namespace kios {

/// trianglesIntersect(), and if they do, some point of the intersection, rounded.
template <typename S>
bool commonPoint(const TriangleVertices<S>& a, const TriangleVertices<S>& b, Point<S>& point);

}  // namespace kios
