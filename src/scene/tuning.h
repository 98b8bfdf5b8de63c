// SPDX-FileCopyrightText: 2026 The fcl_kios authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstddef>

// The constants of this folder that were found by trying, by the row of kios_bench that they serve.
// Without the list of near pairs scene/crowd/within takes 1.6 times as long, and all other rows of
// scene and robot_scenes as long as with it (2026-11-28).

namespace kios::scene::tuning {

/// Queries that a list of near pairs looks ahead, but for no more than a body's radius; and for
/// which none is made after one that is too long or would not last for another.
constexpr long long kQueries = 16;
/// It has room for so many pairs a body.
constexpr std::size_t kPairsOfBody = 8;

}  // namespace kios::scene::tuning
