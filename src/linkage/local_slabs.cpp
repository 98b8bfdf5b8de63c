// SPDX-FileCopyrightText: 2026 The fcl_kios authors
// SPDX-License-Identifier: BSD-3-Clause
#include "linkage/local_slabs.h"

#include "linkage/chain.h"

namespace kios::articulated {
namespace {

continuous::Motion motionOf(const Path& path, int body, int shared, double rounding) {
  return continuous::Motion::known(std::make_shared<const Chain>(path, body, shared), rounding);
}

}  // namespace

// What is taken off every gap for rounding is as well the separation that must be left.
LocalSlabs::LocalSlabs(const Path& path, const Pair& pair, double min_separation)
    : motion_a_(motionOf(path, pair.a, pair.shared, path.pad(pair.a, pair.b) + min_separation)),
      motion_b_(motionOf(path, pair.b, pair.shared, 0)),
      search_(continuous::movingPair(*path.linkage().bodies[pair.a].geometry, motion_a_,
                                     *path.linkage().bodies[pair.b].geometry, motion_b_, counts_)) {
}

double LocalSlabs::provenFrom(double from, double to, long long most_tests) {
  search_->setLimits(to, most_tests);
  const double way = search_->apartFor(from, to - from);
  if (way >= to - from) return to;
  // Rounded towards the start, as `from` + `way` rounds by less than 2^-53.
  const double end = from + way - 0x1p-52;
  return end > from ? end : from;
}

}  // namespace kios::articulated
