// SPDX-FileCopyrightText: 2026 The fcl_kios authors
// SPDX-License-Identifier: BSD-3-Clause

#pragma once

#include <array>
#include <vector>

#include "scenes/triangle_classes.h"

namespace kios::bench {

/// Holds one kernel on one class of triangle pairs, judged by exact rational arithmetic.
struct TriangleScore {
  double max_error = 0;            ///< of the distance, relative to the extent L of each pair
  std::size_t wrong_zeros = 0;     ///< distance 0 of pairs that don't intersect
  std::size_t wrong_nonzeros = 0;  ///< other distances of pairs that do
  std::size_t wrong_verdicts = 0;  ///< of the intersection test
  double distance_ns = 0;          ///< a call, median over repeats
  double intersection_ns = 0;
};

enum TriangleKernel { kOurs, kFcl, kTriangleKernels };

constexpr const char* kTriangleKernelNames[kTriangleKernels] = {"kios", "fcl"};

/// Judges triangleDistance and trianglesIntersect beside fcl::detail::TriangleDistance::triDistance
/// and fcl::detail::Intersect::intersect_Triangle, which take turns at blocks of the same pairs.
std::array<TriangleScore, kTriangleKernels> scoreKernels(
    const std::vector<scenes::TrianglePair>& pairs, int repeats);

}  // namespace kios::bench
