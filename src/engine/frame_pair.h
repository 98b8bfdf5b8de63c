// SPDX-FileCopyrightText: 2026 The fcl_kios authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "engine/tree.h"
#include "fcl_kios/volume/separation.h"

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
/// - the common frame's own rounding in double or float, as in volume/separation.cpp;
/// - a rotation that is one only to `stretch`: radii and bounds scale by at most 1 + stretch on the
///   way to the other frame and back: 2 stretch S.
struct FramePair {
  FloatPose a_from_b, b_from_a;
  float pad;
  float scale;  ///< S
};

/// False if floats can't serve the pair: lengths out of range, or a pad that is not small against
/// both models. The exact search of layer 1 then does.
template <typename S>
bool makeFramePair(const Tree& a, const Tree& b, const RelativePose<S>& X_AB, FramePair& out);

}  // namespace kios::engine
