// SPDX-FileCopyrightText: 2026 The fcl_kios authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

// The constants of this folder that were found by trying, by what they serve: rows of kios_bench
// continuous, or tests of test/linkage (2026-11-28).

namespace kios::continuous::tuning {

/// A step is halved once it has cost so many tests of volumes, and the next one is looked for up to
/// so many times its length.
constexpr long long kLeastBudget = 1000;
constexpr double kLonger = 4;
/// A test of two moving volumes takes as long as so many of two that don't move; with 16 as good.
constexpr long long kTestsOfMoving = 32;
/// A query about a pair at one configuration counts as so many tests, in all budgets.
constexpr long long kTestsOfQuery = 100;
/// Bounds of a motion that aren't the same for every time are taken over so many steps.
constexpr double kWindow = 8;

/// A body that turns by more radians in a step is bounded along chords, in so many parts. Without
/// them screws take 3.3 times as long, splines 1.2 times.
constexpr double kTurnForChords = 0x1p-3;
constexpr int kChords = 4;

/// A triangle's plane is compared with so many nodes of the other tree, and more where one body is
/// split before the other. Without planes, or that order, a rod in its ring takes 40 times as long
/// (TightFits), and the rows of continuous 0.93 times as long.
constexpr int kNodesOfPlane = 48, kNodesOfPlaneInHole = 512;

/// Steps towards the least distance of a range end where distances differ by this part of the
/// bracket; they begin so long where a proof was refuted, a path being of length 1.
constexpr double kLevel = 0x1p-3, kNearby = 0x1p-6;
/// The relative error of distances on the way there: of faces that are parallel, exact ones take a
/// hundred times as long (motions/range/door).
constexpr double kCoarseError = 0x1p-5;

}  // namespace kios::continuous::tuning
