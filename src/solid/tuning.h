// SPDX-FileCopyrightText: 2026 The fcl_kios authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstddef>

// The constants of this folder that were found by trying, for penetrations: of 400 random pairs of
// boxes, plates, gears, balls, tori and blobs, deep and shallow ones, and what another value does
// to the sums of the upper and lower bounds' logarithms and to the time (2026-11-29).

namespace kios::tuning {

/// Steps of whatever goes uphill, shrinks or halves a way. 6: lower bounds are 1.4 % less; 24 do as
/// well.
constexpr int kUphill = 12;
/// Where balls overlap by more of an edge, planes aren't tried. 0.1: 0.6 times the time, but bars
/// that leave several walls at once (test solid_exits) go twice as far as they must.
constexpr double kDeep = 0.5;
/// Corners of planes that are looked at, and points of the polytope between convex solids. 256: 1.1
/// times the time; 64: translations 0.3 % longer.
constexpr std::size_t kCorners = 128;
/// Pairs of triangles that meet are used up to so many. 32: 1.2 times the time; 8: 0.4 % longer. In
/// local depth so many triangles in a piece's way end a move; 32 do as well.
constexpr std::size_t kContacts = 16;
/// An exit, or a ball, is changed for what may be so much better. 0.95 to 0.99 do as well.
constexpr double kEnough = 0.98;
/// Starts on the way out, in parts of the pair's size. 0.25 and 0.5: 3 % longer; 0.05 and 0.5: 2 %.
constexpr double kNear = 0.1, kFar = 0.25;
/// Inner balls, which grow from the square of as many places of the surface. 8 balls: lower bounds
/// are 1.4 % less; 32, and 128 or 512 places, do as well.
constexpr std::size_t kBalls = 16;

// Local depth, found by trying on flush boxes, sheets through blocks, pockets, tori and blobs,
// which docs/solids.md names. Times of solids/depth are within 7 % in the mean of 56 rows, each of
// which differs by 25 % from run to run, for a quarter to four times kMostWithWalls, kTryLater and
// kVisitsPerPiece, a quarter to eight times kMeetings, and kHalf of 0.38 to 0.49 (2026-11-30).

/// Solids with walls are given up after so many pieces.
constexpr long long kMostWithWalls = 4000;
/// A way that parts both solids is tried again after so many times the pieces.
constexpr long long kTryLater = 16;
/// Pieces so many times larger than deep are cut along triangles. 1: solids/depth/balls takes 1.1
/// to 1.3 times as long (2026-11-30).
constexpr double kLarge = 2;
/// Halves are cut here: in the middle, planes of regular meshes would be met.
constexpr double kHalf = 0.4472;
/// Visits of nodes and triangles by moves that count as a piece.
constexpr long long kVisitsPerPiece = 64;
/// Pairs of triangles that are looked at to rule out walls, for each: fans have many.
constexpr std::size_t kMeetings = 512;

}  // namespace kios::tuning
