// SPDX-FileCopyrightText: 2026 The fcl_kios authors
// SPDX-License-Identifier: BSD-3-Clause

#pragma once

#include <cstdint>
#include <functional>
#include <vector>

#include "random.h"
#include "triangle_pair.h"

// The hard cases of two triangles, one generator for the tests and for kios_bench.

namespace kios::scenes {

/// Holds a named family of pairs. All coordinates are finite and at most 1e300 in magnitude.
/// Vertices come in random order and the triangles in either.
struct TriangleClass {
  const char* name;
  std::function<TrianglePair(Random&)> make;
};

/// Returns every class: general position, contacts of every pair of features, exact and rounded,
/// gaps and penetrations, degenerate triangles, slivers, offsets, and scales from denormals to
/// 1e300.
const std::vector<TriangleClass>& triangleClasses();

/// Returns `count` pairs of the class of that index, the same on every platform.
std::vector<TrianglePair> trianglePairs(std::size_t class_index, std::size_t count,
                                        std::uint64_t seed);

}  // namespace kios::scenes
