// SPDX-FileCopyrightText: 2026 The fcl_kios authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cmath>
#include <limits>
#include <memory>
#include <stdexcept>
#include <vector>

#include "fcl_kios/fcl_kios.h"
#include "scenes/motions.h"
#include "scenes/oracle.h"
#include "shapes.h"

// Pairs, poses and options for the tests of kios::distanceBracket and kios::closerThan.

namespace kios::testing {

using scenes::Frame;

template <typename S>
std::shared_ptr<Model<S>> modelOf(const Mesh& mesh) {
  return scenes::buildModel<kIOS<S>>(mesh);
}

/// Returns the mesh with vertices that S can hold.
template <typename S>
Mesh rounded(Mesh mesh) {
  for (fcl::Vector3d& p : mesh.vertices) p = p.template cast<S>().template cast<double>();
  return mesh;
}

inline fcl::Vector3d centreOf(const Mesh& mesh) {
  fcl::Vector3d low = mesh.vertices[0], high = low;
  for (const auto& p : mesh.vertices) {
    low = low.cwiseMin(p);
    high = high.cwiseMax(p);
  }
  return (low + high) / 2;
}

/// Holds random poses, in S, at which both centres lie within `spread` of the origin or of each
/// other.
template <typename S>
struct Poses {
  fcl::Transform3<S> X_WA, X_WB;
};
template <typename S>
std::vector<Poses<S>> posesOf(const Mesh& a, const Mesh& b, int count, double spread,
                              std::uint64_t seed) {
  const auto random = scenes::randomPoses(2 * count, spread, seed);
  std::vector<Poses<S>> poses;
  for (int i = 0; i < count; ++i) {
    fcl::Transform3d X_WA = random[2 * i], X_WB = random[2 * i + 1];
    X_WA.translation() -= X_WA.linear() * centreOf(a);
    X_WB.translation() -= X_WB.linear() * centreOf(b);
    poses.push_back({X_WA.cast<S>(), X_WB.cast<S>()});
  }
  return poses;
}

/// Returns the fault of an answer, or nullptr.
template <typename S>
const char* faultOf(const DistanceBracketResult<S>& answer,
                    const DistanceBracketRequest<S>& options, double exact) {
  const double lower = answer.lower_bound, distance = answer.distance, upper = answer.upper_bound;
  if (!(lower <= exact)) return "the lower bound exceeds the distance";
  if (!(upper >= exact)) return "the upper bound is below the distance";
  if (!(lower >= 0 && lower <= distance && distance <= upper)) return "bounds out of order";
  if ((answer.triangle_a < 0) != std::isinf(distance)) return "a distance of no triangles";
  const double allowed = std::max(double{options.rel_err} * exact, double{options.abs_err});
  switch (answer.stop) {
    case DistanceStop::kTolerance:
      return distance <= exact + allowed + 2 * (upper - distance) ? nullptr : "error too large";
    case DistanceStop::kNear:
      return answer.distance <= options.near_enough ? nullptr : "not near";
    case DistanceStop::kFar:
      return answer.lower_bound >= options.far_enough ? nullptr : "not far";
    case DistanceStop::kBudget:
      return answer.counts.expansions <= options.max_expansions ? nullptr : "over the budget";
  }
  return "no reason to stop";
}

}  // namespace kios::testing
