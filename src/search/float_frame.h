// SPDX-FileCopyrightText: 2026 The fcl_kios authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <Eigen/Core>

#include "fcl_kios/volume.h"
#include "tree/tree.h"

namespace kios::engine {

/// x -> R x + t in float.
struct FloatPose {
  float R[3][3];
  float t[3];
};

/// Two trees in a common query: poses between their origins, and the pad that every float bound
/// pays.
///
/// u = 2^-24, S = a.reach + b.reach + |t|_1. Against exact arithmetic on the model's own vertices
/// in the common frame:
/// - vertices stored in float, relative to the origin: u a coordinate; moved to the other frame:
///   R and t rounded, three products, three sums: 5 u (|x| + |t|) a coordinate, 9 u S in all;
/// - spheres contain the stored vertices; middle +- half rounds by u S; |c - c'| - r - r' takes
///   differences, squares, a root and two more differences: 7 u S. All in all below 20 u S;
/// - planes: unit normals in float and their offsets, 2 u S; the products and sums of a height 5 u
///   S; points 9 u S. Separating directions likewise, with 4 u S more for the normal.
/// 2^-19 S = 32 u S covers each of them, and the rounding of thresholds (a few u S).
/// - boxes, which need not fit as tightly as spheres: below. box_pad has 128 u S in its place.
/// - the common frame's own rounding in double, as in volume/separation.cpp;
/// - a rotation that is one only to `stretch`: radii and bounds scale by at most 1 + stretch on the
///   way to the other frame and back: 2 stretch S; 3 stretch S for the transpose as the inverse.
///
/// Boxes of either tree: c a centre, e_i axes, h_i half extents, with every point p at |e_i . (p -
/// c)| <= h_i. All points lie in a sphere of radius r that holds the box's slabs to |(c - c0)_i| +
/// h_i <= r, so |c| <= sqrt(3) reach and |h| <= sqrt(3) r. Along any w of length 1 (an axis of
/// either, a line between points of both) two contents are apart by at least
///   |w . (c' - c)| - sum |w . e_i| h_i - sum |w . e'_i| h'_i,
/// and by the root of the sum of the squares of three such gaps, one an axis. As computed, with
/// primes for the box that is moved, both are off by at most
/// - vertices as they are stored: u (reach + reach');
/// - axes that are orthonormal but for one rounding each: p - c is a sum of h_i times dual axes,
///   off by 2 sqrt(3) u in all: 6 u (r + r'); once moved, as w, off by 12 u: 12 u S;
/// - e' moved as above, 4 u |R| |e'| a coordinate, |R| and the three |e'| stretching by sqrt(3)
///   each: 12 u |h'| = 21 u r'; c' likewise 5 u sqrt(3) |c'| + 2 u |t| = 15 u reach' + 2 u |t|;
/// - products with w: 3 u sqrt(3) |h| = 9 u r for either, 4 u |c' - c| <= 7 u (reach + reach') +
///   4 u |t|; their sum, of 7 roundings: 12 u (r + r'); the difference and the quotient by |w|,
///   or the root of a sum of squares: 7 u S.
/// These are 54 u of the reach that stands still, 90 u of that which moves, and 25 u |t|: below
/// 96 u S. A ball in place of either box takes fewer, and its bound pays the pad twice. What
/// vanishes below 2^-126 is far below 128 u S, as S >= 2^-35: see distanceBounds().
///
/// Products of axes (acrossEdges()) take w = C_1j e_2 - C_2j e_1, with C_ij = e_i . e'_j, C as
/// computed, off by 3 u. It is e_0 x e'_j but for rounding, no longer than 1, and its dots with all
/// axes are elements of C, which are used in their place. Vertices, axes and their moves cost what
/// they do above: 18 u r, 51 u reach' + 14 u |t|. Then, with c' - c as computed,
/// - w . (c' - c), from dots off by 4 u |c' - c| each: 8 u |c' - c| <= 14 u (reach + reach') +
///   8 u |t|;
/// - |w . e_i| h_i: axes at right angles but for 4 u, 12 u r; products and sums 4 u r;
/// - |w . e'_j| h'_j, which is left out: 5 u h'_j; the other two are minors of C, which equal
///   elements of C for rotations; e' are off by 8 u, e by u, so minors by 30 u, elements by 12 u:
///   42 u (h'_1 + h'_2), in all 110 u r'; products and sums 4 u r'.
/// These are 48 u of the reach that stands still, 180 u of that which moves, and 22 u |t|: below
/// 192 u S, for which twice the pad is taken.
struct FloatFrame {
  FloatPose a_from_b, b_from_a;
  float pad;
  float box_pad;
  float scale;  ///< S
};

/// Where tree b is in tree a's frame, in double, and how far off bounds are in floats.
struct TreePose {
  Eigen::Matrix3d R;
  Eigen::Vector3d t;
  double stretch, pad, box_pad, scale;
  double frame_error;  ///< the last two items of FloatFrame's list, which double pays, too
};

/// False if floats can't serve the pair: lengths out of range, or models so far apart for their
/// sizes that the pad hides either.
bool makeTreePose(const Tree& a, const Tree& b, const RelativePose<double>& X_AB, TreePose& out);
void makeFloatFrame(const TreePose& X_AB, FloatFrame& out);

}  // namespace kios::engine
