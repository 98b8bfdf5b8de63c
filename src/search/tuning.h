// SPDX-FileCopyrightText: 2026 The fcl_kios authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstddef>
#include <cstdint>

// The constants of searches that were found by trying, each with the row of kios_bench that it
// serves, and the values that do as well: within 3 % of that row's tests and leaf pairs, or of its
// time. All were measured on 2026-11-28, unless another date is given. They change no answer.

namespace kios::engine::tuning {

/// Leaves are split into their triangles in searches where a leaf of one tree is so many times as
/// wide as the mean leaf of the other is large.
constexpr float kWideLeaf = 8;
/// Such a leaf is split where it is wider than the pair is far apart and so many times the node is
/// large.
constexpr float kSplitLeaf = 4;
/// The direction across a leaf is tried in distances with a bound on entry where the mean leaf is
/// so many times as large as the other's.
constexpr float kGroundLeaf = 2;
/// Boxes are tested in contact where spheres overlap by less than this part of the smaller node.
constexpr float kLittleOverlap = 0.25F;
/// A wave of exact distances takes what lies within this part of the way from the nearest bound to
/// cull_distance; one of bracketed distances, which may end early, less.
constexpr float kWave = 0.5F, kBracketWave = 0.125F;
/// Pairs that are expanded together; in contact, where boxes tell which way leads deepest, fewer.
constexpr std::size_t kBatch = 4, kBoxedContactBatch = 2;
/// Steps of Frank-Wolfe between two leaves.
constexpr int kFrankWolfeSteps = 2;
/// Bounds in double that may fail in a row, at first and after as many as proved something.
constexpr int kFirstDoubles = 1, kMostDoubles = 4;
/// Slabs of a hull that are kept.
constexpr std::uint32_t kSlabs = 16;
/// Floats tell little of what is far smaller than the other, but what in that is near it.
constexpr double kFarAway = 4, kCoarse = 0x1p-4;
/// The largest relative error for which the search for exact distances is as fast.
constexpr double kExactError = 0.01;

}  // namespace kios::engine::tuning
