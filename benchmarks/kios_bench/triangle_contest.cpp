// SPDX-FileCopyrightText: 2026 The fcl_kios authors
// SPDX-License-Identifier: BSD-3-Clause

#include "triangle_contest.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include <fcl/narrowphase/detail/primitive_shape_algorithm/triangle_distance.h>
#include <fcl/narrowphase/detail/traversal/collision/intersect.h>
#include <fcl_kios/triangle/distance.h>
#include <fcl_kios/triangle/intersection.h>

#include "race.h"
#include "scenes/rational_oracle.h"

namespace kios::bench {
namespace {

using scenes::TrianglePair;

constexpr std::size_t kBlock = 256;

struct Ours {
  static double distance(const TrianglePair& pair) {
    return triangleDistance(pair.a, pair.b).distance;
  }
  static double intersect(const TrianglePair& pair) { return trianglesIntersect(pair.a, pair.b); }
};

struct Fcl {
  static double distance(const TrianglePair& pair) {
    fcl::Vector3d p, q;
    return fcl::detail::TriangleDistance<double>::triDistance(pair.a.data(), pair.b.data(), p, q);
  }
  static double intersect(const TrianglePair& pair) {
    return fcl::detail::Intersect<double>::intersect_Triangle(pair.a[0], pair.a[1], pair.a[2],
                                                              pair.b[0], pair.b[1], pair.b[2]);
  }
};

template <double (*kCall)(const TrianglePair&)>
Competitor kernel(const std::vector<TrianglePair>& pairs, std::vector<double>& answers) {
  answers.resize(pairs.size());
  return {"", [&](std::size_t begin, std::size_t end) {
            for (std::size_t i = begin; i < end; ++i) answers[i] = kCall(pairs[i]);
          }};
}

// An answer that is no number is an infinite error. Rounding to the least double is none.
double relativeError(double distance, long double exact, long double extent) {
  if (!std::isfinite(distance)) return std::numeric_limits<double>::infinity();
  const long double error = std::abs(static_cast<long double>(distance) - exact);
  if (error <= std::numeric_limits<double>::denorm_min()) return 0;
  return static_cast<double>(error / extent);
}

}  // namespace

std::array<TriangleScore, kTriangleKernels> scoreKernels(const std::vector<TrianglePair>& pairs,
                                                         int repeats) {
  std::vector<double> distances[kTriangleKernels], verdicts[kTriangleKernels];
  std::vector<Competitor> for_distance = {kernel<Ours::distance>(pairs, distances[kOurs]),
                                          kernel<Fcl::distance>(pairs, distances[kFcl])};
  std::vector<Competitor> for_verdict = {kernel<Ours::intersect>(pairs, verdicts[kOurs]),
                                         kernel<Fcl::intersect>(pairs, verdicts[kFcl])};
  const Race race{pairs.size(), repeats, kBlock};
  race.run(for_distance);
  race.run(for_verdict);
  std::array<TriangleScore, kTriangleKernels> scores;
  for (std::size_t k = 0; k < kTriangleKernels; ++k) {
    scores[k].distance_ns = 1000 * timesOf(for_distance[k], pairs.size(), nullptr).median_us;
    scores[k].intersection_ns = 1000 * timesOf(for_verdict[k], pairs.size(), nullptr).median_us;
  }
  for (std::size_t i = 0; i < pairs.size(); ++i) {
    const scenes::RationalDistance exact = scenes::rationalDistance(pairs[i]);
    const long double extent = scenes::extent(pairs[i]);
    for (std::size_t k = 0; k < kTriangleKernels; ++k) {
      TriangleScore& score = scores[k];
      const double distance = distances[k][i];
      score.max_error = std::max(score.max_error, relativeError(distance, exact.distance, extent));
      score.wrong_zeros += distance == 0 && !exact.intersect;
      score.wrong_nonzeros += distance != 0 && exact.intersect;
      score.wrong_verdicts += (verdicts[k][i] != 0) != exact.intersect;
    }
  }
  return scores;
}

}  // namespace kios::bench
