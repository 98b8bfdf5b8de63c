// SPDX-FileCopyrightText: 2026 The fcl_kios authors
// SPDX-License-Identifier: BSD-3-Clause
//
// Exact distance of two k-IOS beside the conservative bound and FCL's RSS: time a pair, and how
// much of the true distance of the contents each finds. Contents are patches of 1 to 64 triangles
// of a bumpy torus, at random poses, a gap of 0.01 to 3 patch sizes apart.

#include <algorithm>
#include <cstdio>
#include <limits>
#include <numeric>
#include <string>
#include <vector>

#include <fcl/math/bv/RSS.h>
#include <fcl/math/bv/utility.h>

#include "clearance/exact_pair.h"
#include "fcl_kios/build/fit.h"
#include "scenario.h"
#include "scenes/motions.h"
#include "scenes/oracle.h"
#include "scenes/random.h"
#include "scenes/shapes.h"

namespace kios::bench {
namespace {

constexpr double kInfinity = std::numeric_limits<double>::infinity();

/// Returns the `count` triangles of `mesh` nearest to one of them.
scenes::Mesh patch(const scenes::Mesh& mesh, scenes::Random& random, int count) {
  const auto corner = [&mesh](std::size_t t) { return mesh.vertices[mesh.triangles[t][0]]; };
  const fcl::Vector3d center =
      corner(static_cast<std::size_t>(random.unit() * static_cast<double>(mesh.triangles.size())));
  std::vector<std::size_t> order(mesh.triangles.size());
  std::iota(order.begin(), order.end(), std::size_t{0});
  std::partial_sort(order.begin(), order.begin() + count, order.end(),
                    [&](std::size_t p, std::size_t q) {
                      return (corner(p) - center).norm() < (corner(q) - center).norm();
                    });
  scenes::Mesh part;
  for (int i = 0; i < count; ++i) {
    const fcl::Triangle& t = mesh.triangles[order[static_cast<std::size_t>(i)]];
    const std::size_t first = part.vertices.size();
    for (int c = 0; c < 3; ++c) part.vertices.push_back(mesh.vertices[t[c]] - center);
    part.triangles.emplace_back(first, first + 1, first + 2);
  }
  return part;
}

struct Pair {
  kIOSd a, b;
  exact::SphereIntersection body_a, body_b;
  fcl::RSSd rss_a, rss_b;
  RelativePose<double> X_AB;
  double truth;
  double size;
};

template <typename BV>
BV fitted(const scenes::Mesh& mesh) {
  BV bv;
  fit(mesh.vertices.data(), static_cast<int>(mesh.vertices.size()), bv);
  return bv;
}

std::vector<Pair> draw(int triangles, int count) {
  const scenes::Mesh torus = scenes::bumpyTorus(4000);
  scenes::Random random(static_cast<std::uint64_t>(triangles));
  std::vector<Pair> pairs;
  for (fcl::Transform3d X : scenes::randomPoses(count, 1, 7)) {
    const scenes::Mesh a = patch(torus, random, triangles), b = patch(torus, random, triangles);
    const double size = (scenes::extent(a) + scenes::extent(b)) / 2;
    X.translation().normalize();
    X.translation() *= size * (0.6 + 3 * random.unit() * random.unit());
    const double truth = scenes::MeshOracle(a, b).distance(fcl::Transform3d::Identity(), X);
    if (!(truth > 0.01 * size)) continue;
    const kIOSd va = fitted<kIOSd>(a), vb = fitted<kIOSd>(b);
    pairs.push_back({va, vb, exact::SphereIntersection(va), exact::SphereIntersection(vb),
                     fitted<fcl::RSSd>(a), fitted<fcl::RSSd>(b),
                     RelativePose<double>(X.linear(), X.translation()), truth, size});
  }
  return pairs;
}

/// Holds a distance or a bound of it.
struct Way {
  const char* bv;
  double (*distance)(const Pair& pair);
};

constexpr Way kWays[] = {
    {"kios_separation",
     [](const Pair& p) { return std::max(0.0, separation(p.a, p.b, p.X_AB, kInfinity)); }},
    {"fcl_rss",
     [](const Pair& p) { return fcl::distance(p.X_AB.R(), p.X_AB.T(), p.rss_a, p.rss_b); }},
    {"kios_exact", [](const Pair& p) { return exactDistance(p.a, p.b, p.X_AB).distance; }},
    {"kios_exact_prepared",
     [](const Pair& p) {
       return exact::exactDistance(p.a, p.body_a, p.b, p.body_b, p.X_AB).distance;
     }},
};

/// A bound above the true distance is wrong. FCL's RSS is as right as its own rounding.
std::size_t wrongBounds(const std::vector<Pair>& pairs, const Way& way) {
  constexpr double kRounding = 1e-12;
  return static_cast<std::size_t>(
      std::count_if(pairs.begin(), pairs.end(), [&way](const Pair& pair) {
        return way.distance(pair) > pair.truth + kRounding * pair.size;
      }));
}

std::vector<Row> rowsOf(int triangles, const std::vector<Pair>& pairs, const Options& options) {
  std::vector<Competitor> competitors;
  double sum = 0;  // so that nothing is optimised away
  for (const Way& way : kWays) {
    competitors.push_back({way.bv, [&](std::size_t begin, std::size_t end) {
                             for (std::size_t i = begin; i < end; ++i)
                               sum += way.distance(pairs[i]);
                           }});
  }
  Race{pairs.size(), options.repeats}.run(competitors);
  if (!(sum > 0)) std::printf("no distance is found\n");
  Row base;
  base.scenario = "exact/" + std::to_string(triangles);
  base.query = "distance";
  base.triangles = static_cast<std::size_t>(2 * triangles);
  base.frames = pairs.size();
  base.seed = options.seed;
  std::vector<Row> rows;
  for (std::size_t i = 0; i < std::size(kWays); ++i) {
    double found = 0;
    for (const Pair& pair : pairs) found += kWays[i].distance(pair) / pair.truth;
    Row& row = rows.emplace_back(base.of(competitors[i]));
    row.volumes.tightness = found / static_cast<double>(pairs.size());
    row.errors.wrong = wrongBounds(pairs, kWays[i]);
  }
  return rows;
}

}  // namespace

void reportExactBounds(const Options& options, Report& report) {
  const int count = options.frames > 0 ? options.frames : (options.quick ? 40 : 2000);
  for (const int triangles : {1, 2, 4, 16, 64}) {
    report.add(rowsOf(triangles, draw(triangles, count), options));
  }
}

}  // namespace kios::bench
