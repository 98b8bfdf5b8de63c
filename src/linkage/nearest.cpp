// SPDX-FileCopyrightText: 2026 The fcl_kios authors
// SPDX-License-Identifier: BSD-3-Clause
#include "linkage/nearest.h"

#include <algorithm>

#include "linkage/tuning.h"

namespace kios::articulated {

std::vector<std::pair<double, Pair>> Nearest::pairs(const Configuration& c, double far) {
  const BodyQueries queries(c.path(), 0, counts_);
  std::vector<std::pair<double, Pair>> found;
  const auto add = [&](const Pair& pair) {
    const double bound = queries.rootBound(pair, c, far);
    if (bound < far) found.emplace_back(bound, pair);
  };
  if (only_) {
    add(*only_);
  } else {
    near_pairs_.forEach(c.path(), c, far, 0, add);
  }
  std::sort(found.begin(), found.end(), [](const auto& x, const auto& y) {
    return std::make_tuple(x.first, x.second.a, x.second.b) <
           std::make_tuple(y.first, y.second.a, y.second.b);
  });
  return found;
}

continuous::Sight Nearest::at(const Configuration& c, double far, double rel_err) {
  continuous::Sight best;
  best.distance = far;
  for (auto& [bound, pair] : pairs(c, far)) {
    if (bound >= best.distance || !(best.distance > 0)) break;
    const continuous::Sight sight = of(pair, c, best.distance, rel_err).upper;
    if (sight.distance < best.distance) best = sight;
  }
  if (best.a < 0) best.distance = kInfinity;
  return best;
}

Nearest::Distance Nearest::of(Pair& pair, const Configuration& c, double far, double rel_err) {
  ++counts_.queries;
  const BodyQueries queries(c.path(), 0, counts_);
  Distance distance;
  distance.lower = queries.slab(pair, c, far);
  if (distance.lower >= far) return distance;
  queries.requireServed(pair.a, pair.b);
  const Measured near = queries.measure(pair, c, far, rel_err);
  const bool contact = near.contact || (!(distance.lower > 0) && queries.areSolids(pair) &&
                                        queries.inContact(pair, c));
  distance.lower = contact ? 0 : std::max({0.0, distance.lower, near.lower});
  distance.upper = {contact ? 0 : near.upper, pair.a, pair.b, near.point_a, near.point_b};
  if (contact) distance.upper.point_a = distance.upper.point_b = continuous::Sight().point_a;
  return distance;
}

}  // namespace kios::articulated
