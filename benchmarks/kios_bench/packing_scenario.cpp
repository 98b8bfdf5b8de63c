// SPDX-FileCopyrightText: 2026 The fcl_kios authors
// SPDX-License-Identifier: BSD-3-Clause
//
// Two k-IOS in SIMD: the paper packs four sphere pairs of one pair of volumes into a test, the
// engine puts eight volumes into the lanes of one.

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <functional>
#include <string>
#include <vector>

#include "engine/rows.h"
#include "fcl_kios/bv/separation.h"
#include "fcl_kios/fcl/model.h"
#include "paper/packing_tests.h"
#include "scenario.h"
#include "scenes/motions.h"
#include "scenes/random.h"
#include "scenes/shapes.h"
#include "timing.h"

namespace kios::bench {
namespace {

using namespace paper;

using Volumes = std::vector<kIOSf>;

/// The same pairs as the library's own test of two volumes takes them.
struct LibraryPairs {
  std::vector<RelativePose<float>> X_AB;
  Volumes b, a;
};

SphereSet spheresOf(const kIOSf& bv) {
  SphereSet set;
  set.k = bv.k();
  for (int i = 0; i < set.k; ++i) {
    const fcl::Vector3f c = bv.sphereCenter(i);
    set.x[i] = c[0];
    set.y[i] = c[1];
    set.z[i] = c[2];
    set.r[i] = bv.sphereRadius(i);
  }
  set.repeat();
  return set;
}

/// The eight nodes three levels below node `at`; fewer if the tree ends before.
void descendants(const Modelf& model, int at, int levels, Volumes& out) {
  const auto& node = model.getBV(at);
  if (levels == 0) {
    out.push_back(node.bv);
  } else if (!node.isLeaf()) {
    descendants(model, node.leftChild(), levels - 1, out);
    descendants(model, node.rightChild(), levels - 1, out);
  }
}

std::shared_ptr<Modelf> modelOf(const scenes::Mesh& mesh, FitMethod method) {
  return scenes::buildModel<kIOSf>(mesh, std::make_shared<fcl::detail::BVFitter<kIOSf>>(method));
}

/// Pairs as a search meets them: children of a node whose S0 meets that of a node of its size, in
/// the falling tori.
void draw(FitMethod method, int groups, std::uint64_t seed, PackingPairs& pairs,
          LibraryPairs& library) {
  const auto a = modelOf(scenes::knobbyTorus(), method), b = modelOf(scenes::bentTorus(), method);
  const auto frames = scenes::fallingMotion(100);
  scenes::Random random(seed);
  const auto below = [&random](int n) { return static_cast<int>(random.unit() * n); };
  while (static_cast<int>(pairs.groups()) < groups) {
    const scenes::Frame& frame = frames[below(100)];
    const fcl::Transform3f X = (frame.X_WB.inverse() * frame.X_WA).cast<float>();
    const RelativePose<float> X_AB(X.linear(), X.translation());
    const int at = below(a->getNumBVs());
    const kIOSf& node_a = a->getBV(at).bv;
    const kIOSf& node_b = b->getBV(below(b->getNumBVs())).bv;
    const float ra = node_a.radius0, rb = node_b.radius0;
    const float apart = (X_AB * node_b.center0 - node_a.center0).norm();
    if (std::min(ra, rb) < 0.5F * std::max(ra, rb) || apart > ra + rb) continue;
    Volumes children;
    descendants(*a, at, 3, children);
    if (children.size() != 8) continue;

    engine::FloatPose pose;
    for (int i = 0; i < 3; ++i) {
      for (int j = 0; j < 3; ++j) pose.R[i][j] = X.linear()(i, j);
      pose.t[i] = X.translation()[i];
    }
    pairs.X_AB.push_back(pose);
    pairs.b.push_back(spheresOf(node_b));
    pairs.node_b.emplace_back();
    engine::writeSpheres(node_b, pairs.node_b.back());
    pairs.a.emplace_back();
    pairs.block_a.emplace_back();
    library.X_AB.push_back(X_AB);
    library.b.push_back(node_b);
    for (int lane = 0; lane < 8; ++lane) {
      pairs.a.back()[lane] = spheresOf(children[lane]);
      engine::Node node;
      engine::writeSpheres(children[lane], node);
      engine::writeLane(node, lane, pairs.block_a.back());
      library.a.push_back(children[lane]);
    }
  }
}

/// One way to test all pairs.
struct Way {
  std::string bv;
  std::optional<std::string> target;
  std::function<void(bool overlap, float* bounds, PackingCounts& counts)> test;
  std::vector<double> distance_ns, overlap_ns;  // a pair, by repeat
};

double timeOf(const Way& way, bool overlap, std::vector<float>& bounds, int sweeps) {
  PackingCounts counts;
  const double start = nowMicroseconds();
  for (int i = 0; i < sweeps; ++i) way.test(overlap, bounds.data(), counts);
  return 1000 * (nowMicroseconds() - start) / (static_cast<double>(bounds.size()) * sweeps);
}

std::vector<Way> waysOf(const PackingPairs& pairs, const LibraryPairs& library) {
  const auto over = [&pairs](PackingTest test) {
    return [test, &pairs](bool overlap, float* bounds, PackingCounts& counts) {
      test(pairs, overlap, bounds, counts);
    };
  };
  std::vector<Way> ways;
  ways.push_back({"scalar", {}, over(testScalar), {}, {}});
  ways.push_back({"packed_by_four", {}, over(testPackedByFour), {}, {}});
  ways.push_back({"kios_separation",
                  {},
                  [&library](bool overlap, float* bounds, PackingCounts& counts) {
                    constexpr double kInfinity = std::numeric_limits<double>::infinity();
                    for (std::size_t i = 0; i < library.a.size(); ++i) {
                      const auto g = i / 8;
                      bounds[i] = static_cast<float>(separation(
                          library.a[i], library.b[g], library.X_AB[g], overlap ? 0.0 : kInfinity));
                      counts.scalar += 1;
                      counts.packed += 6;
                    }
                  },
                  {},
                  {}});
  for (const EightNodesTest& eight : eightNodesTests()) {
    ways.push_back({"kios_eight_nodes", eight.target, over(eight.test), {}, {}});
  }
  return ways;
}

void reportPairs(const std::string& scenario, FitMethod method, const Options& options,
                 Report& report) {
  const int groups = options.frames > 0 ? options.frames : 128;
  const int sweeps = options.quick ? 2 : 200;
  PackingPairs pairs;
  LibraryPairs library;
  draw(method, groups, options.seed, pairs, library);
  std::vector<Way> ways = waysOf(pairs, library);
  const std::size_t count = library.a.size();

  std::vector<float> exact(count), bounds(count);
  PackingCounts ignored;
  ways[0].test(false, exact.data(), ignored);
  for (int repeat = 0; repeat < options.repeats; ++repeat) {
    for (std::size_t turn = 0; turn < ways.size(); ++turn) {
      Way& way = ways[(turn + static_cast<std::size_t>(repeat)) % ways.size()];
      way.distance_ns.push_back(timeOf(way, false, bounds, sweeps));
      way.overlap_ns.push_back(timeOf(way, true, bounds, sweeps));
    }
  }

  double spheres = 0;
  for (const kIOSf& bv : library.a) spheres += bv.k() / static_cast<double>(count);
  std::printf("%s: %zu pairs, k = %.2f on average\n", scenario.c_str(), count, spheres);
  std::printf("%-18s %-7s %9s %9s %9s %9s %9s %9s %9s %6s\n", "test", "target", "distance",
              "overlap", "packed", "alone", "bound", "apart", "apart(1)", "wrong");
  std::vector<Row> rows;
  for (const Way& way : ways) {
    for (const bool overlap : {false, true}) {
      PackingCounts counts;
      way.test(overlap, bounds.data(), counts);
      Row row;
      row.scenario = scenario;
      row.query = overlap ? "collide" : "distance";
      row.bv = way.bv;
      row.frames = count;
      const auto& ns = overlap ? way.overlap_ns : way.distance_ns;
      row.median_us = median(ns) / 1000;
      row.min_us = *std::min_element(ns.begin(), ns.end()) / 1000;
      row.bv_tests = static_cast<double>(counts.packed + counts.scalar) / double(count);
      row.mean_spheres = spheres;
      row.simd_target = way.target;
      row.seed = options.seed;
      // All ways must agree with the scalar loop: packed ones bitwise, ours never above it.
      std::size_t apart = 0, apart_by_all = 0, positive = 0;
      double tightness = 0;
      row.wrong_verdicts = 0;
      for (std::size_t i = 0; i < count; ++i) {
        const float tolerance = 1e-5F * (std::abs(exact[i]) + library.a[i].radius0 + 1);
        const bool same = overlap ? (bounds[i] > 0) == (exact[i] > 0) : bounds[i] == exact[i];
        const bool below = bounds[i] <= exact[i] + tolerance;
        const bool ours = way.bv.rfind("kios", 0) == 0;
        if (ours ? !below : !same) ++*row.wrong_verdicts;
        apart += bounds[i] > 0 ? 1 : 0;
        apart_by_all += exact[i] > 0 ? 1 : 0;
        if (!overlap && exact[i] > tolerance) {
          ++positive;
          tightness += std::max(bounds[i], 0.0F) / exact[i];
        }
      }
      if (positive > 0) row.tightness = tightness / static_cast<double>(positive);
      rows.push_back(row);
      if (!overlap) continue;
      const Row& distance = rows[rows.size() - 2];
      PackingCounts of_distance;
      way.test(false, bounds.data(), of_distance);
      std::printf("%-18s %-7s %6.2f ns %6.2f ns %9.2f %9.2f %9.4f %9zu %9zu %6zu\n", way.bv.c_str(),
                  way.target.value_or("").c_str(), 1000 * distance.median_us, 1000 * row.median_us,
                  double(of_distance.packed) / double(count),
                  double(of_distance.scalar) / double(count), distance.tightness.value_or(0), apart,
                  apart_by_all, *row.wrong_verdicts + *distance.wrong_verdicts);
    }
  }
  std::printf("\n");
  report.addUnprinted(rows);
}

}  // namespace

void runPacking(const Options& options, Report& report) {
  reportPairs("packing/method_ii", FitMethod::kMethodII, options, report);
  reportPairs("packing/tuned", FitMethod::kTuned, options, report);
}

}  // namespace kios::bench
