// SPDX-FileCopyrightText: 2026 The fcl_kios authors
// SPDX-License-Identifier: BSD-3-Clause
#include "search/ray_search.h"

#include <algorithm>

#include "volume/rounding.h"

namespace kios::engine {

float toLength(const Tree& tree, double s) {
  const double most = 4 * double{tree.reach};
  return roundedTo<float>(std::clamp(s, -most, most));
}

RayFit makeFloatRay(const Tree& tree, const RayLine& line, double t_min, double t_max,
                    RayLine::Near& near, FloatRay& ray) {
  const double reach = tree.reach;
  near = line.nearTo(fcl::Vector3d(tree.origin[0], tree.origin[1], tree.origin[2]), tree.exponent);
  const double pad = 0x1p-18 * reach + near.error;
  const Node& root = tree.nodes[0];
  const double within = fcl::Vector3d(root.x[kCentral], root.y[kCentral], root.z[kCentral]).norm() +
                        double{root.r[kCentral]} + pad;
  if (near.from_it.norm() > within) return RayFit::kMiss;
  if (!(near.error <= 0x1p-6 * reach)) {
    ray = {{0, 0, 0}, {1, 0, 0}, 16 * tree.reach, -4 * tree.reach, 4 * tree.reach};
    return RayFit::kBlind;
  }
  for (int c = 0; c < 3; ++c) {
    ray.origin[c] = roundedTo<float>(-near.from_it[c]);
    ray.direction[c] = roundedTo<float>(line.unit()[c]);
  }
  ray.pad = roundUpFloat(pad);
  ray.begin = toLength(tree, line.lengthOf(t_min, near.t, tree.exponent));
  ray.end = toLength(tree, line.lengthOf(t_max, near.t, tree.exponent));
  return ray.begin > within || ray.end < -within ? RayFit::kMiss : RayFit::kServed;
}

}  // namespace kios::engine
