// SPDX-FileCopyrightText: 2026 The fcl_kios authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

// The constants of builds and fits that were found by trying, each with what it serves and the
// values that do as well, by expansions of falling and spinning tori with the prototype of 0.1; the
// others have not been measured since.

namespace kios::tuning {

/// Bins along an axis of a node. 32 and 1024 do as well, 8 costs 5 to 9 %.
constexpr int kBins = 16;
/// Up to so many triangles all splits along two axes are tried. 16: 0.82 of the
/// speed of world/building, 1.02 of world's (2026-11-30).
constexpr int kSweep = 32;
/// A part of a frame's triangles so small gets a frame of its own, if it is no leaf. 1: rows of
/// world take 0.35 to 1.5 times as long, 0.98 in the mean (2026-11-30).
constexpr int kReframe = 2;
/// Triangles of a block, which fits the cache; by how many a larger node is cut. A quarter to four
/// times: build/models within 3 % in the mean (2026-11-30).
constexpr int kBlock = 2048, kSample = 512;
/// Below this ratio of extents the caps of an axis cut off next to nothing. 1 to 1.1 do as well,
/// 1.25 costs 4 % of the volume tests, 1.5 9 %.
constexpr float kRatio = 1.1F;
/// Steps that centre a sphere, by Sets. 3 each: 0.98 of the speed of tori, by counts
/// of tests (2026-11-30).
constexpr int kSteps[] = {1, 3, 8};
/// A sphere is centred between two points where that leaves so much of its radius. 1: builds take
/// 1.05 to 1.19 times as long (2026-11-30).
constexpr float kCentred = 1.02F;
/// Thicker sets have S0 centred along their shortest axis too. Never: 0.96 of
/// the speed of tori, by counts of tests (2026-11-30).
constexpr float kThick = 0.08F;

}  // namespace kios::tuning
