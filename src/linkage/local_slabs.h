// SPDX-FileCopyrightText: 2026 The fcl_kios authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <memory>

#include "continuous/moving_pair.h"
#include "linkage/body_queries.h"

namespace kios::articulated {

/// Proves intervals of a path for one pair by a slab for each two of its triangles. That serves
/// what no distance and no slab of hulls does: a peg in its hole, a shaft in its bearing, a ball in
/// its socket. Of the bodies one is a mesh.
class LocalSlabs {
 public:
  LocalSlabs(const Path& path, const Pair& pair, double min_separation);

  /// The end, at most `to`, of an interval from `from` on that is proven; `from` itself if none is.
  /// Makes little more than `most_tests` tests.
  double provenFrom(double from, double to, long long most_tests);
  /// Tests made.
  long long cost() const { return search_->cost(); }

 private:
  ContinuousCounts counts_;
  const continuous::Motion motion_a_, motion_b_;
  const std::unique_ptr<continuous::StepSearch> search_;
};

}  // namespace kios::articulated
