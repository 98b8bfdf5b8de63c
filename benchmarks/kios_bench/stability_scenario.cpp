// SPDX-FileCopyrightText: 2026 The fcl_kios authors
// SPDX-License-Identifier: BSD-3-Clause
//
// Distance and intersection of triangles over hard classes of pairs, judged by exact rational
// arithmetic: triangleDistance and trianglesIntersect beside FCL's triDistance and
// intersect_Triangle.
#include <algorithm>
#include <cmath>
#include <limits>
#include <string>
#include <vector>

#include <fcl/narrowphase/detail/primitive_shape_algorithm/triangle_distance.h>
#include <fcl/narrowphase/detail/traversal/collision/intersect.h>
#include <fcl_kios/triangle.h>

#include "scenario.h"
#include "scenes/rational_oracle.h"
#include "scenes/triangle_classes.h"

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
Competitor kernel(const char* name, const std::vector<TrianglePair>& pairs,
                  std::vector<double>& answers) {
  answers.resize(pairs.size());
  return {name, [&](std::size_t begin, std::size_t end) {
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

/// Errors are relative to the extent of each pair; wrong is a distance of 0 of pairs that don't
/// intersect, or another of pairs that do, and a wrong verdict of the intersection test.
std::vector<Row> rowsOf(const std::string& name, const std::vector<TrianglePair>& pairs,
                        const Options& options) {
  std::vector<double> answers[2][2];  // by query and kernel
  std::vector<Competitor> competitors[2] = {{kernel<Ours::distance>("kios", pairs, answers[0][0]),
                                             kernel<Fcl::distance>("fcl", pairs, answers[0][1])},
                                            {kernel<Ours::intersect>("kios", pairs, answers[1][0]),
                                             kernel<Fcl::intersect>("fcl", pairs, answers[1][1])}};
  Row base = baseRow("stability/" + name, "", pairs.size());
  base.triangles = 2;
  base.extent = 1;
  base.errors.wrong = 0;
  std::vector<Row> rows;
  for (const int query : {0, 1}) {
    Race{pairs.size(), options.repeats, kBlock}.run(competitors[query]);
    base.query = query == 0 ? "distance" : "collide";
    for (const int k : {0, 1}) {
      rows.push_back(base.of(competitors[query][k]));
      if (query == 0) rows.back().errors.max_abs = 0;
    }
  }
  for (std::size_t i = 0; i < pairs.size(); ++i) {
    const scenes::RationalDistance exact = scenes::rationalDistance(pairs[i]);
    const long double extent = scenes::extent(pairs[i]);
    for (const int k : {0, 1}) {
      const double distance = answers[0][k][i];
      double& worst = *rows[k].errors.max_abs;
      worst = std::max(worst, relativeError(distance, exact.distance, extent));
      *rows[k].errors.wrong += (distance == 0) != exact.intersect;
      *rows[2 + k].errors.wrong += (answers[1][k][i] != 0) != exact.intersect;
    }
  }
  return rows;
}

}  // namespace

void runStability(const Options& options, Report& report) {
  if (wanted(options, "queries")) reportStress(options, report);
  if (!wanted(options, "triangles")) return;
  const int pairs = options.frames > 0 ? options.frames : (options.quick ? 40 : 2000);
  for (std::size_t c = 0; c < scenes::triangleClasses().size(); ++c) {
    report.add(rowsOf(scenes::triangleClasses()[c].name,
                      scenes::trianglePairs(c, pairs, options.seed), options));
  }
}

}  // namespace kios::bench
