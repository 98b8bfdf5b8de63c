// SPDX-FileCopyrightText: 2026 The fcl_kios authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "fcl_kios/triangle.h"

namespace kios {

/// Returns the part of all directions from p in which it sees a triangle, between -1/2 and 1/2:
/// positive if the normal points away from p. Off by at most 2^-46, or 2^-102 over the product of
/// the distances of p from the two nearest edges, in sizes of the triangle. 0 if p lies on it.
double solidAngle(const Pointd& p, const TriangleVerticesd& t);

}  // namespace kios
