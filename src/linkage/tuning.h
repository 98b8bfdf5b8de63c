// SPDX-FileCopyrightText: 2026 The fcl_kios authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstddef>

#include "continuous/tuning.h"

// The constants of this folder that were found by trying, by what they serve: rows of kios_bench
// motions and mbm, or tests of test/linkage (2026-11-28).

namespace kios::articulated::tuning {

/// Configurations that are kept. With one, motions take 1.2 times as long.
constexpr std::size_t kCached = 16;
/// An interval is asked about as near to its middle as this share of it allows for a number of few
/// bits, so that many pairs are asked about in one configuration. With 0, free motions of 0.2 rad
/// take 1.1 times as long.
constexpr double kAside = 0.1;
/// A slab that proves this share of an interval spares it a query. With 1, motions of
/// two arms take 1.17 times as long.
constexpr double kSlabShare = 0.35;
/// Steps towards the widest slab, which end where this share of the possible width is reached. With
/// 3 steps, motions of two arms take 1.5 times as long.
constexpr int kSlabSteps = 6;
constexpr double kClose = 0.9;
/// Where volumes leave more pairs, they ask about both halves of an interval, down to this half.
/// Without, edges of a UR5 of 0.8 rad take 1.7 times as long (mbm).
constexpr std::size_t kMany = 16;
constexpr double kShortest = 1.0 / 16;
/// No slab is looked for between balls that overlap by more of the smaller radius.
constexpr double kDeep = -0.4;
/// Times that a slab is tried to last for, the whole interval first.
constexpr int kTries = 5;

/// The unit of cost of all provers is a test of two volumes, some 15 ns; two leaves that a query's
/// search looks into count as so many, beside the query.
using continuous::tuning::kTestsOfQuery;
constexpr long long kTestsOfLeaves = 64;

/// Where so many intervals can't be decided, no contact is looked for in what else is left.
constexpr int kMostUndecided = 256;
/// Bodies close in more slowly than the bounds say: what is proven must come nearer to the first
/// contact than the resolution is long (FirstContact).
constexpr double kApproach = 0x1p-8;

/// The tree of so few obstacles is built anew with each that comes, which takes 3 us and leaves it
/// as good as one that is built at once (mbm's rows).
constexpr long long kFewObstacles = 64;

/// Rounds of steps along the coordinates of a box towards nearer configurations.
constexpr int kRounds = 8;
/// In a box a distance may be off by this part of what the pair moves by.
constexpr double kOfMotion = 0.25;

}  // namespace kios::articulated::tuning
