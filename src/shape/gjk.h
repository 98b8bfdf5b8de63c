// SPDX-FileCopyrightText: 2026 The fcl_kios authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "shape/solid.h"

namespace kios::shape {

/// A bracket of the distance between the hull of up to three points and a solid's core.
struct CoreDistance {
  double lower;  ///< by a separating slab: <= the distance, but for its rounding; may be negative
  double upper;  ///< |point - on_core|
  bool inside;   ///< the hull and the core overlap (or are apart by rounding), by a tetrahedron of
                 ///< differences around the origin
  Vec point;     ///< of the hull
  Vec on_core;   ///< of the core
};

/// GJK in double, by support points alone, so that it serves every bounded solid. Ends when the
/// bracket is closed to rounding, when nothing improves any more, once `lower` exceeds `required`,
/// or after `max_iterations` steps. Pairs that overlap by less than about 1e-8 of their size may
/// end without `inside`, with a small upper and no positive lower. Source: Gilbert, Johnson &
/// Keerthi (1988); the duality gap as in van den Bergen (1999).
CoreDistance gjkDistance(const Solid& solid, const Vec* hull, int num_points, double required,
                         int max_iterations = 128);

}  // namespace kios::shape
