// SPDX-FileCopyrightText: 2026 The fcl_kios authors
// SPDX-License-Identifier: BSD-3-Clause
//
// usage: kios_exact [PAIRS]
// Exact distance of two k-IOS beside the conservative bound and FCL's RSS: time a pair, and how
// much of the true distance of the contents each bound finds. Contents are patches of 1 to 64
// triangles of a bumpy torus, at random poses a gap of 0.01 to 3 patch sizes apart. All timed in
// turn on the same pairs.
#include <ctime>

#include <algorithm>
#include <cstdio>
#include <cstdlib>
#include <functional>
#include <numeric>
#include <vector>

#include "exact/exact_pair.h"
#include "exact/nearest_pair.h"
#include "fcl/math/bv/RSS.h"
#include "fcl/math/bv/utility.h"
#include "fcl_kios/fit/fit.h"
#include "scenes/motions.h"
#include "scenes/oracle.h"
#include "scenes/random.h"
#include "scenes/shapes.h"

namespace {

using namespace kios;

constexpr double kInfinity = std::numeric_limits<double>::infinity();

double nanoseconds() {
  timespec now;
  clock_gettime(CLOCK_THREAD_CPUTIME_ID, &now);
  return 1e9 * static_cast<double>(now.tv_sec) + static_cast<double>(now.tv_nsec);
}

/// The `count` triangles of `mesh` nearest to one of them.
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
  exact::BallBody body_a, body_b;
  fcl::RSSd rss_a, rss_b;
  RelativePose<double> X_AB;
  double truth;
};

template <typename BV>
BV fitted(const scenes::Mesh& mesh) {
  BV bv;
  fit(mesh.vertices.data(), static_cast<int>(mesh.vertices.size()), bv);
  return bv;
}

double timeOf(const std::vector<Pair>& pairs, const std::function<double(const Pair&)>& distance) {
  std::vector<double> times;
  double sum = 0;
  for (int repeat = 0; repeat < 5; ++repeat) {
    const double start = nanoseconds();
    for (const Pair& pair : pairs) sum += distance(pair);
    times.push_back((nanoseconds() - start) / static_cast<double>(pairs.size()));
  }
  if (!(sum > 0)) std::puts("all pairs meet");
  return *std::min_element(times.begin(), times.end());
}

}  // namespace

int main(int argc, char** argv) {
  const int count = argc > 1 ? std::atoi(argv[1]) : 2000;
  const scenes::Mesh torus = scenes::bumpyTorus(4000);
  std::printf("%9s | %10s %9s %9s %9s | %6s %6s %6s | %6s\n", "triangles", "separation", "RSS",
              "exact", "prepared", "sep", "exact", "RSS", "slabs");
  for (const int triangles : {1, 2, 4, 16, 64}) {
    scenes::Random random(static_cast<std::uint64_t>(triangles));
    const auto poses = scenes::randomPoses(count, 1, 7);
    std::vector<Pair> pairs;
    double slabs = 0, found[3] = {};
    for (int i = 0; i < count; ++i) {
      const scenes::Mesh a = patch(torus, random, triangles), b = patch(torus, random, triangles);
      const double size = (scenes::extent(a) + scenes::extent(b)) / 2;
      fcl::Transform3d X = poses[static_cast<std::size_t>(i)];
      X.translation().normalize();
      X.translation() *= size * (0.6 + 3 * random.unit() * random.unit());
      const kIOSd va = fitted<kIOSd>(a), vb = fitted<kIOSd>(b);
      const RelativePose<double> X_AB(X.linear(), X.translation());
      const double truth = scenes::MeshOracle(a, b).distance(fcl::Transform3d::Identity(), X);
      if (!(truth > 0.01 * size)) continue;
      pairs.push_back({va, vb, exact::BallBody(va), exact::BallBody(vb), fitted<fcl::RSSd>(a),
                       fitted<fcl::RSSd>(b), X_AB, truth});
      const Pair& pair = pairs.back();
      slabs += exact::nearestPair(pair.body_a, pair.body_b, X_AB.R,
                                  X_AB.R * vb.center0 + X_AB.T - va.center0)
                   .probes;
      found[0] += std::max(0.0, separation(va, vb, X_AB, kInfinity)) / truth;
      found[1] += exactDistance(va, vb, X_AB).distance / truth;
      found[2] += fcl::distance(X_AB.R, X_AB.T, pair.rss_a, pair.rss_b) / truth;
    }
    const double n = static_cast<double>(pairs.size());
    const double bound =
        timeOf(pairs, [](const Pair& p) { return separation(p.a, p.b, p.X_AB, kInfinity); });
    const double rss = timeOf(
        pairs, [](const Pair& p) { return fcl::distance(p.X_AB.R, p.X_AB.T, p.rss_a, p.rss_b); });
    const double whole =
        timeOf(pairs, [](const Pair& p) { return exactDistance(p.a, p.b, p.X_AB).distance; });
    const double prepared = timeOf(pairs, [](const Pair& p) {
      return exact::exactDistance(p.a, p.body_a, p.b, p.body_b, p.X_AB).distance;
    });
    std::printf("%9d | %7.0f ns %6.0f ns %6.0f ns %6.0f ns | %6.3f %6.3f %6.3f | %6.1f\n",
                triangles, bound, rss, whole, prepared, found[0] / n, found[1] / n, found[2] / n,
                slabs / n);
  }
}
