// SPDX-FileCopyrightText: 2026 The fcl_kios authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "fcl_kios/query/distance.h"
#include "query/mesh_pair.h"

namespace kios {

/// The answer of kios::distance(), but for the nearest points: in A's frame, set if a pair was
/// found.
template <typename S>
DistanceAnswer<S> bracketDistance(const MeshPair<S>& frame, const engine::PairQuery& query);

/// Answers for root volumes that were tested: they prove `roots`, which is below far_enough > 0.
template <typename S>
DistanceAnswer<S> bracketDistance(const MeshPair<S>& frame, const engine::PairQuery& query,
                                  double roots);

}  // namespace kios
