// SPDX-FileCopyrightText: 2026 The fcl_kios authors
// SPDX-License-Identifier: BSD-3-Clause
#include "search/ray_search.h"

#include <algorithm>

#include "tree/prepare.h"
#include "volume/rounding.h"

namespace kios::engine {

float toLength(const Tree& tree, double s) {
  const double most = 4 * double{tree.reach};
  return static_cast<float>(std::clamp(s, -most, most));
}

RayFit makeFloatRay(const Tree& tree, const RayLine& line, double t_min, double t_max,
                    RayLine::Near& near, FloatRay& ray) {
  const double reach = tree.reach;
  if (!(reach >= kLeastReach && reach <= kLargestReach)) return RayFit::kRefused;
  near = line.nearTo(fcl::Vector3d(tree.origin[0], tree.origin[1], tree.origin[2]), 0);
  if (!(near.error <= 0x1p-6 * reach)) return RayFit::kRefused;
  const double pad = 0x1p-18 * reach + near.error;
  if (near.from_it.norm() > reach + pad) return RayFit::kMiss;
  for (int c = 0; c < 3; ++c) {
    ray.origin[c] = static_cast<float>(-near.from_it[c]);
    ray.direction[c] = static_cast<float>(line.unit()[c]);
  }
  ray.pad = roundUpFloat(pad);
  ray.begin = toLength(tree, line.lengthOf(t_min, near.t, 0));
  ray.end = toLength(tree, line.lengthOf(t_max, near.t, 0));
  return RayFit::kServed;
}

}  // namespace kios::engine
