// SPDX-FileCopyrightText: 2026 The fcl_kios authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <memory>

#include "continuous/step_search.h"
#include "linkage/body_queries.h"
#include "linkage/chain.h"

namespace kios::articulated {

/// Proves intervals of a path for one pair by a slab for each two of its triangles. That serves
/// what no distance and no slab of hulls does: a peg in its hole, a shaft in its bearing, a ball in
/// its socket. Of the bodies one is a mesh.
class LocalSlabs {
 public:
  // What is taken off every gap for rounding is as well the separation that must be left.
  LocalSlabs(const Path& path, const Pair& pair, double min_separation)
      : motion_a_(motionOf(path, pair.a, pair.shared, path.pad(pair.a, pair.b) + min_separation)),
        motion_b_(motionOf(path, pair.b, pair.shared, 0)),
        search_(continuous::movingPair(*path.linkage().bodies[pair.a].own->geometry, motion_a_,
                                       *path.linkage().bodies[pair.b].own->geometry, motion_b_,
                                       counts_)) {}

  /// The end, at most `to`, of an interval from `from` on that is proven; `from` itself if none is.
  /// Makes little more than `most_tests` tests.
  double provenFrom(double from, double to, long long most_tests) {
    search_->setLimits(to, most_tests);
    const double way = search_->apartFor(from);
    if (way >= to - from) return to;
    // Rounded towards the start, as `from` + `way` rounds by less than 2^-53.
    const double end = from + way - 0x1p-52;
    return end > from ? end : from;
  }
  /// Tests made.
  long long cost() const { return search_->cost(); }

 private:
  static continuous::Motion motionOf(const Path& path, int body, int shared, double rounding) {
    return continuous::Motion::known(std::make_shared<const Chain>(path, body, shared), rounding);
  }

  ContinuousCounts counts_;
  const continuous::Motion motion_a_, motion_b_;
  const std::unique_ptr<continuous::StepSearch> search_;
};

}  // namespace kios::articulated
