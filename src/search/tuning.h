// SPDX-FileCopyrightText: 2026 The fcl_kios authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstddef>

// The constants of searches that were found by trying, each with what it serves, and the speed of
// rows of kios_bench with something else in its place, measured on 2026-11-28 and 30 by kios_bench
// --compare; "not measured": not since it was chosen. They change no exact answer.

namespace kios::engine::tuning {

/// Leaves are split into triangles where those of one tree are so many times as wide as the other's
/// mean leaf is large. Never: 0.02 to 0.14 of world/terrain_1m; 16: 0.02 of world/shelf. In
/// distances with a bound on entry the direction across a leaf is tried if the mean leaf is so many
/// times as large as the other's; 2 does as well there. Never, and boxes at each step of the
/// descent: 0.85 of closerThan() at a table.
constexpr float kWideLeaf = 8;
/// Such a leaf is split where it is wider than the pair is far apart and so many times the node is
/// large. By the leaf's size: 0.5 to 0.6 of world/strips; 8: 0.03 of world/shelf.
constexpr float kSplitLeaf = 4;
/// A wave takes what lies within this part of the way from the nearest bound to cull_distance.
/// 0.125: 0.99 of tori (0.89 to 1.27), 1.01 of world, 0.99 of the brackets of kios_bench error.
constexpr float kWave = 0.5F;
/// Pairs expanded together; of boxes in contact fewer. 16 in large trees: 0.86 to 0.98 of scaling.
/// 4 boxed: 0.79 of hits in world/crate and stairs.
constexpr std::size_t kBatch = 4, kBoxedContactBatch = 2;
/// Steps of Frank-Wolfe between two leaves. 1: 0.61 of world/table; 3 do as well.
constexpr int kFrankWolfeSteps = 2;

}  // namespace kios::engine::tuning
