// SPDX-FileCopyrightText: 2026 The fcl_kios authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cmath>
#include <limits>

#include "volume/rounding.h"

// This header bounds the rounding errors of queries: each bound that several places pay is derived
// here, once.
//
// The model of error: u is the unit roundoff of S, 2^-53 for double, 2^-24 for float. Each product,
// sum, quotient and root is off by a factor of 1 + e, |e| <= u, or by less than what vanishes below
// the scalar's range. Products and sums are those of fcl_kios/detail/rigid.h, in one order. To
// first order n roundings of terms whose absolute values add up to m err by n u m; every constant
// leaves room for the second order.
//
//   quantity                                 bound           derivation
//   length from coordinates R x + T - c      sumError        11 u in, 12 u of root and sums
//   bound of two volumes at a pose           volumeError     sumError of all lengths that enter
//   point in the common frame                frameError      12.2 u |x|_1 + 8.7 u |T|_2
//   stretch of a rotation that is none       stretchOf       |E1| and |E2|, known to 3 u a term
//   bound of spheres in float lanes          laneError       16 roundings, and as many again
//   bound of boxes in float lanes            boxError        96 roundings, and a third more
//   distance of two triangles                triangleError   16 eps, by the kernel's contract
//   distance of two features                 featureError    32 u each
//   length between a shape and a triangle    solidError      5 roundings a coordinate, the kernels'
//
// A test measures how much of each bound rounding takes (test/volume/error_bounds_test.cpp).

namespace kios::error_bounds {

template <typename S>
inline constexpr double kUlp = sizeof(S) == sizeof(double) ? kUlpDouble : kUlpFloat;

/// Squares and products below the range of S vanish: lengths lose less than that.
template <typename S>
inline constexpr double kVanishing = sizeof(S) == sizeof(double) ? 0x1p-1070 : 0x1p-145;

/// Bounds the error of a length that comes from coordinates R x + T - c: a coordinate takes 6
/// roundings of terms that add up to at most `sum`, the three together are off by 11 u of it at
/// most, and the root and the few sums that follow by less than 12 u more, of lengths that `sum`
/// includes. Twice for two objects: 32 u with room.
template <typename S>
double sumError(double sum) {
  return 32 * kUlp<S> * sum;
}

/// Bounds the error of the distance of a's spheres from those of b, whose points R y + T, |y|_1 <=
/// center1 + 1.8 r, are as S rounds them: `center1` is |c_b|_1, `others1` is |T|_1 + |c_a|_1, and
/// the radii are those of the central spheres.
template <typename S>
double volumeError(double center1, double others1, double radius_a, double radius_b) {
  return sumError<S>(1.8 * center1 + others1 + radius_a + 4 * radius_b) + kVanishing<S>;
}

/// Bounds the error, as a vector, of a point x of B in the common frame, x -> R1^T (R2 x + (t2 -
/// t1)): |x|_1 <= norm1, T the frame's translation. R takes 3 roundings an entry, R x 4 more, and
/// the sum one; in absolute values these are 7 u |R1|^T |R2| |x| and 5 u |R1|^T |t2 - t1|. Columns
/// of |R2| have length 1 and |R1|^T stretches by at most sqrt(3), so 12.2 u |x|_1 and 8.7 u
/// |T|_2; 1.01 is for rotations that are ones only to 1e-3.
template <typename S>
double frameError(double norm1, double T_norm1) {
  return 16 * kUlp<S> * 1.01 * (norm1 + T_norm1) + kVanishing<S>;
}

/// Returns `stretch` with |R|_2 - 1 <= stretch for R = R1^T R2: |R|_2 <= sqrt(1 + |E1|) sqrt(1 +
/// |E2|) < 1 + (|E1| + |E2|) / 2 + |E1| |E2|, and |E1| + |E2| is at most sqrt(2) times the root of
/// the sum of their squares, which is `squared_errors`. E and the product's entries are known to 3
/// u a term.
template <typename S>
double stretchOf(double squared_errors) {
  return 0.71 * std::sqrt(squared_errors) + 20 * kUlp<S>;
}

/// Bounds the error of a bound computed in float lanes, `scale` the sum of all lengths that enter:
/// 16 roundings of 2^-24 at most (volume/separation.cpp and search/float_frame.h count them), and
/// as much again.
inline double laneError(double scale) { return 0x1p-19 * scale; }

/// Bounds that of a bound of boxes in float lanes: at most 96 roundings of 2^-24, which
/// search/float_frame.h counts (test/search/box_bounds_test.cpp measures them), and a third more.
inline double boxError(double scale) { return 4 * laneError(scale); }

/// Bounds that of the distance of two triangles: the kernel promises 16 eps of their extent, the
/// diagonal of their common box (fcl_kios/triangle.h).
template <typename S>
double triangleError(double extent) {
  return 32 * kUlp<S> * extent + kVanishing<S>;
}

/// The extent of triangles that are d apart, one in each of two balls: the box's diagonal is at
/// most sqrt(3) times the largest distance in it.
inline double extentOf(double d, double radius_a, double radius_b) {
  return 1.74 * (std::abs(d) + 2 * radius_a + 2 * radius_b);
}

/// Bounds the difference of the distance of two features, evaluated by themselves, from that of
/// their triangles, in double: each is known to 32 u of the extent.
inline double featureError(double extent) { return 64 * kUlpDouble * extent; }

/// Bounds that of a length between a shape and a volume or a triangle, in double: 5 roundings a
/// coordinate of the pose, and less than 2^-48 of the lengths from the kernels of src/shape.
inline double solidError(double lengths) { return 0x1p-46 * lengths; }

}  // namespace kios::error_bounds
