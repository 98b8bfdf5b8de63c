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

#include "scenes/rational_oracle.h"
#include "timing.h"

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

using Call = double (*)(const TrianglePair&);

template <Call call>
void answerBlock(const std::vector<TrianglePair>& pairs, std::size_t begin, std::size_t end,
                 std::vector<double>& answers) {
  for (std::size_t i = begin; i < end; ++i) answers[i] = call(pairs[i]);
}

using AnswerBlock = void (*)(const std::vector<TrianglePair>&, std::size_t, std::size_t,
                             std::vector<double>&);

struct Answers {
  std::vector<double> values;
  double ns = 0;
};

std::array<Answers, kTriangleKernels> answersOf(
    const std::array<AnswerBlock, kTriangleKernels>& kernels,
    const std::vector<TrianglePair>& pairs, int repeats) {
  std::array<Answers, kTriangleKernels> all;
  std::array<std::vector<double>, kTriangleKernels> repeat_us;
  for (Answers& answers : all) answers.values.resize(pairs.size());
  for (int repeat = 0; repeat < repeats; ++repeat) {
    for (auto& us : repeat_us) us.push_back(0);
    for (std::size_t begin = 0, block = 0; begin < pairs.size(); begin += kBlock, ++block) {
      const std::size_t end = std::min(begin + kBlock, pairs.size());
      for (std::size_t turn = 0; turn < kTriangleKernels; ++turn) {
        const std::size_t k = (turn + block + repeat) % kTriangleKernels;
        const double start = nowMicroseconds();
        kernels[k](pairs, begin, end, all[k].values);
        repeat_us[k].back() += nowMicroseconds() - start;
      }
    }
  }
  for (std::size_t k = 0; k < kTriangleKernels; ++k) {
    all[k].ns = 1000 * median(repeat_us[k]) / static_cast<double>(pairs.size());
  }
  return all;
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
  const auto distances =
      answersOf({answerBlock<Ours::distance>, answerBlock<Fcl::distance>}, pairs, repeats);
  const auto verdicts =
      answersOf({answerBlock<Ours::intersect>, answerBlock<Fcl::intersect>}, pairs, repeats);
  std::array<TriangleScore, kTriangleKernels> scores;
  for (std::size_t k = 0; k < kTriangleKernels; ++k) {
    scores[k].distance_ns = distances[k].ns;
    scores[k].intersection_ns = verdicts[k].ns;
  }
  for (std::size_t i = 0; i < pairs.size(); ++i) {
    const scenes::RationalDistance exact = scenes::rationalDistance(pairs[i]);
    const long double extent = scenes::extent(pairs[i]);
    for (std::size_t k = 0; k < kTriangleKernels; ++k) {
      TriangleScore& score = scores[k];
      const double distance = distances[k].values[i];
      score.max_error = std::max(score.max_error, relativeError(distance, exact.distance, extent));
      score.wrong_zeros += distance == 0 && !exact.intersect;
      score.wrong_nonzeros += distance != 0 && exact.intersect;
      score.wrong_verdicts += (verdicts[k].values[i] != 0) != exact.intersect;
    }
  }
  return scores;
}

}  // namespace kios::bench
