// SPDX-FileCopyrightText: 2026 The fcl_kios authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <gtest/gtest.h>

#include <map>
#include <string>
#include <utility>
#include <vector>

#include "solid/solid_meshes.h"

namespace kios::testing {

using Parts = std::vector<ClashPart>;
using Pair = std::pair<std::size_t, std::size_t>;

inline ClashPart partOf(std::shared_ptr<const Modeld> model, const fcl::Transform3d& X,
                        std::size_t i) {
  ClashPart part;
  part.geometry = std::move(model);
  part.X_WP = X;
  part.name = "part " + std::to_string(i);
  return part;
}

inline std::map<Pair, ClashResult> byPair(const std::vector<ClashResult>& clashes) {
  std::map<Pair, ClashResult> found;
  Pair last{0, 0};
  for (const ClashResult& clash : clashes) {
    const Pair pair{clash.a, clash.b};
    EXPECT_LT(clash.a, clash.b);
    EXPECT_LT(last, pair);
    EXPECT_LE(clash.lower, clash.upper);
    found[last = pair] = clash;
  }
  return found;
}

inline fcl::Vector3d toVector(const double (&p)[3]) { return {p[0], p[1], p[2]}; }

inline ClashResult only(const Parts& parts, const ClashRequest& request = {}) {
  const auto clashes = findClashes(parts, request);
  EXPECT_EQ(clashes.size(), 1u);
  return clashes.empty() ? ClashResult() : clashes[0];
}

}  // namespace kios::testing
