// SPDX-FileCopyrightText: 2026 The fcl_kios authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "fcl_kios/triangle/triangle.h"

namespace kios {

/// trianglesIntersect(), and if they do, some point of the intersection, rounded.
bool commonPoint(const TriangleVertices<double>& a, const TriangleVertices<double>& b,
                 Point<double>& point);

}  // namespace kios
