// SPDX-FileCopyrightText: 2026 The fcl_kios authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <vector>

#include "contest.h"

namespace kios::bench {

/// What a pair of links costs depends on how near it is.
enum class PairClass {
  kRootReject,  ///< the root volumes alone are proof that it is apart
  kApart,       ///< farther apart than 2 % of the larger link's extent
  kNear,
  kHit
};

/// Returns "root_reject", "apart", "near", "hit".
const char* name(PairClass pair_class);

/// Returns the questions of each class in turn, in their order.
std::vector<std::vector<Question>> byClass(const std::vector<scenes::Mesh>& meshes,
                                           const std::vector<Question>& questions);

}  // namespace kios::bench
