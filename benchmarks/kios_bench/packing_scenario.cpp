// SPDX-FileCopyrightText: 2026 The fcl_kios authors
// SPDX-License-Identifier: BSD-3-Clause
//
// Two k-IOS in SIMD: the paper packs four sphere pairs of one pair of volumes into a test, the
// engine puts eight volumes into the lanes of one.

#include <algorithm>
#include <cmath>
#include <functional>
#include <string>
#include <vector>

#include "fcl_kios/model/model.h"
#include "fcl_kios/paper/fit.h"
#include "fcl_kios/volume/separation.h"
#include "paper/packing_tests.h"
#include "scenario.h"
#include "scenes/motions.h"
#include "scenes/random.h"
#include "scenes/shapes.h"
#include "tree/node_layout.h"

namespace kios::bench {
namespace {

using namespace paper;

using Nodes = std::vector<kIOSf>;

/// Takes the pairs as the library's own test of two volumes does.
struct LibraryPairs {
  std::vector<RelativePose<float>> X_AB;
  Nodes b, a;
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

engine::Node nodeOf(const kIOSf& bv) {
  Eigen::Vector3f centers[engine::kSphereRows];
  double radii[engine::kSphereRows];
  for (int i = 0; i < engine::kSphereRows; ++i) {
    centers[i] = bv.sphereCenter(i < bv.k() ? i : 0);
    radii[i] = bv.sphereRadius(i < bv.k() ? i : 0);
  }
  engine::Node node;
  engine::writeSpheres(centers, radii, node);
  return node;
}

/// The eight nodes three levels below node `at`; fewer if the tree ends before.
void descendants(const Modelf& model, int at, int levels, Nodes& out) {
  const auto& node = model.getBV(at);
  if (levels == 0) {
    out.push_back(node.bv);
  } else if (!node.isLeaf()) {
    descendants(model, node.leftChild(), levels - 1, out);
    descendants(model, node.rightChild(), levels - 1, out);
  }
}

std::shared_ptr<Modelf> modelOf(const scenes::Mesh& mesh, FitMethod method) {
  return scenes::buildModel<kIOSf>(mesh, std::make_shared<PaperFitter<float>>(method));
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
    Nodes children;
    descendants(*a, at, 3, children);
    if (children.size() != 8) continue;

    engine::FloatPose pose;
    for (int i = 0; i < 3; ++i) {
      for (int j = 0; j < 3; ++j) pose.R[i][j] = X.linear()(i, j);
      pose.t[i] = X.translation()[i];
    }
    pairs.X_AB.push_back(pose);
    pairs.b.push_back(spheresOf(node_b));
    pairs.node_b.push_back(nodeOf(node_b));
    pairs.a.emplace_back();
    pairs.block_a.emplace_back();
    library.X_AB.push_back(X_AB);
    library.b.push_back(node_b);
    for (int lane = 0; lane < 8; ++lane) {
      pairs.a.back()[lane] = spheresOf(children[lane]);
      engine::writeLane(nodeOf(children[lane]), lane, pairs.block_a.back());
      library.a.push_back(children[lane]);
    }
  }
}

/// One way to test all pairs.
struct Way {
  std::string bv;
  std::optional<std::string> target;
  std::function<void(bool overlap, float* bounds, PackingCounts& counts)> test;
};

std::vector<Way> waysOf(const PackingPairs& pairs, const LibraryPairs& library) {
  const auto over = [&pairs](PackingTest test) {
    return [test, &pairs](bool overlap, float* bounds, PackingCounts& counts) {
      test(pairs, overlap, bounds, counts);
    };
  };
  const auto by_library = [&library](bool overlap, float* bounds, PackingCounts& counts) {
    constexpr double kInfinity = std::numeric_limits<double>::infinity();
    for (std::size_t i = 0; i < library.a.size(); ++i) {
      const auto g = i / 8;
      bounds[i] = static_cast<float>(
          separation(library.a[i], library.b[g], library.X_AB[g], overlap ? 0.0 : kInfinity));
      counts.scalar += 1;
      counts.packed += 6;
    }
  };
  std::vector<Way> ways = {{"scalar", {}, over(testScalar)},
                           {"packed_by_four", {}, over(testPackedByFour)},
                           {"kios_separation", {}, by_library}};
  for (const EightNodesTest& eight : eightNodesTests()) {
    ways.push_back({"kios_eight_nodes", eight.target, over(eight.test)});
  }
  return ways;
}

/// Sets the work and the errors of a row: all ways must agree with the scalar loop, packed ones
/// bitwise, ours never above it.
void judge(const Way& way, bool overlap, const std::vector<float>& exact, const Nodes& nodes,
           Row& row) {
  const std::size_t count = exact.size();
  PackingCounts counts;
  std::vector<float> bounds(count);
  way.test(overlap, bounds.data(), counts);
  row.tests.bvs = static_cast<double>(counts.packed + counts.scalar) / double(count);
  std::size_t positive = 0, wrong = 0;
  double tightness = 0;
  for (std::size_t i = 0; i < count; ++i) {
    const float tolerance = 1e-5F * (std::abs(exact[i]) + nodes[i].radius0 + 1);
    const bool same = overlap ? (bounds[i] > 0) == (exact[i] > 0) : bounds[i] == exact[i];
    const bool below = bounds[i] <= exact[i] + tolerance;
    const bool ours = way.bv.rfind("kios", 0) == 0;
    if (ours ? !below : !same) ++wrong;
    if (!overlap && exact[i] > tolerance) {
      ++positive;
      tightness += std::max(bounds[i], 0.0F) / exact[i];
    }
  }
  row.errors.wrong = wrong;
  if (positive > 0) row.volumes.tightness = tightness / static_cast<double>(positive);
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
  std::vector<Competitor> timed[2];  // whether volumes overlap, their distance
  for (const bool overlap : {false, true}) {
    for (const Way& way : ways) {
      timed[overlap].push_back({way.bv, [&, overlap](std::size_t, std::size_t) {
                                  for (int i = 0; i < sweeps; ++i) {
                                    way.test(overlap, bounds.data(), ignored);
                                  }
                                }});
    }
    Race{1, options.repeats}.run(timed[overlap]);
  }

  Row base;
  base.scenario = scenario;
  base.frames = count;
  base.seed = options.seed;
  base.volumes.mean_spheres = 0;
  for (const kIOSf& bv : library.a) {
    *base.volumes.mean_spheres += bv.k() / static_cast<double>(count);
  }
  std::vector<Row> rows;
  for (std::size_t w = 0; w < ways.size(); ++w) {
    for (const bool overlap : {false, true}) {
      base.query = overlap ? "collide" : "distance";
      Row& row = rows.emplace_back(base);
      row.bv = ways[w].bv;
      row.times = timesOf(timed[overlap][w], count * static_cast<std::size_t>(sweeps), nullptr);
      row.simd_target = ways[w].target;
      judge(ways[w], overlap, exact, library.a, row);
    }
  }
  report.add(rows);
}

}  // namespace

void reportPacking(const Options& options, Report& report) {
  reportPairs("packing/method_ii", FitMethod::kMethodII, options, report);
  reportPairs("packing/tuned", FitMethod::kTuned, options, report);
}

}  // namespace kios::bench
