// SPDX-FileCopyrightText: 2026 The fcl_kios authors
// SPDX-License-Identifier: BSD-3-Clause

#pragma once

#include <array>

#include <Eigen/Core>

// Distance and intersection of two triangles in long double: the judge of every answer in tests and
// benchmarks. Written for accuracy and shares no code with FCL or with the library.

namespace kios::scenes {

/// Holds a point in extended precision (64-bit significand on x86; plain double where long double
/// is).
using ExactPoint = Eigen::Matrix<long double, 3, 1>;
using ExactTriangle = std::array<ExactPoint, 3>;

/// Returns the distance of two closed triangles in one frame, 0 where trianglesMeet. Every
/// candidate is the distance of a point of one to a point of the other, so the result is never too
/// small by more than rounding; all feature pairs are tried, so it is too large by a few
/// long-double roundings of the triangles' extent at most, for any aspect ratio down to 1e-16.
/// Degenerate triangles are allowed.
long double triangleDistance(const ExactTriangle& a, const ExactTriangle& b);

/// True if the closed triangles share a point: an edge of one meets the face of the other, or both
/// are coplanar and overlap. Signs are evaluated in long double, exact enough in general position;
/// exactly decided for coordinates that are integers of up to 20 bits.
bool trianglesMeet(const ExactTriangle& a, const ExactTriangle& b);

}  // namespace kios::scenes
