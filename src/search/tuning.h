// SPDX-FileCopyrightText: 2026 The fcl_kios authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstddef>
#include <cstdint>

// The constants of searches that were found by trying, each with what it serves, and the speed of
// rows of kios_bench with something else in its place as measured on 2026-11-28 and 30 by kios_bench
// --compare; "not measured": not since it was chosen. They change no answer.

namespace kios::engine::tuning {

/// Leaves are split into triangles where those of one tree are so many times as wide as the other's
/// mean leaf is large. Never: 0.02 to 0.14 of world/terrain_1m. In distances with a bound on entry
/// the direction across a leaf is tried if the mean leaf is so many times as large as the other's;
/// 2 does as well there. Never, and boxes at each step of the descent: 0.85 of closerThan() at a
/// table.
constexpr float kWideLeaf = 8;
/// Such a leaf is split where it is wider than the pair is far apart and so many times the node is
/// large. By the leaf's size: 0.5 to 0.6 of world/strips. Other values: not measured.
constexpr float kSplitLeaf = 4;
/// A wave of exact distances takes what lies within this part of the way from the nearest bound to
/// cull_distance; one of bracketed distances, which may end early, less: not measured.
constexpr float kWave = 0.5F, kBracketWave = 0.125F;
/// Pairs expanded together; of boxes in contact fewer. 16 in large trees: 0.86 to 0.98 of scaling.
constexpr std::size_t kBatch = 4, kBoxedContactBatch = 2;
/// Steps of Frank-Wolfe between two leaves: not measured.
constexpr int kFrankWolfeSteps = 2;
/// Slabs of a hull that are kept: not measured.
constexpr std::uint32_t kSlabs = 16;

}  // namespace kios::engine::tuning
