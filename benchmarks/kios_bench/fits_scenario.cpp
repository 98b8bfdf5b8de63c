// SPDX-FileCopyrightText: 2026 The fcl_kios authors
// SPDX-License-Identifier: BSD-3-Clause
//
// Every construction of k-IOS and the volumes of others over one tree and one traversal.

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <limits>
#include <memory>
#include <string>
#include <vector>

#include "contest.h"
#include "fit_entrant.h"
#include "motion_report.h"
#include "scenario.h"
#include "scenes/motions.h"
#include "scenes/pqp_data.h"
#include "scenes/random.h"
#include "scenes/shapes.h"
#include "timing.h"
#include "verdicts.h"

namespace kios::bench {
namespace {

using Poses = std::vector<RelativePose<double>>;

struct Scene {
  std::string name;
  scenes::Mesh a, b;
  std::vector<scenes::Frame> frames;
};

double distanceOf(const MeshSplit& a, const MeshSplit::Node& m, const MeshSplit& b,
                  const MeshSplit::Node& n, const RelativePose<double>& X_AB) {
  double distance = std::numeric_limits<double>::infinity();
  for (int s = 0; s < m.count; ++s) {
    const TriangleVertices<double> p = a.corners(a.triangle(m.first + s));
    for (int t = 0; t < n.count; ++t) {
      TriangleVertices<double> q = b.corners(b.triangle(n.first + t));
      for (Point<double>& corner : q) corner = X_AB * corner;
      distance = std::min(distance, triangleDistance(p, q).distance);
    }
  }
  return distance;
}

/// Pairs of nodes of up to 64 triangles and of similar size, turned at random and moved to between
/// a hundredth of their size and that size apart, each with its true distance.
std::vector<NodePair> sampleNodes(const MeshSplit& a, const MeshSplit& b, int count,
                                  std::uint64_t seed) {
  constexpr int kMostTriangles = 64;
  scenes::Random random(seed);
  const auto draw = [&random](const MeshSplit& of) {
    for (;;) {
      const int i = static_cast<int>(random.unit() * static_cast<double>(of.nodes().size()));
      if (of.nodes()[static_cast<std::size_t>(i)].count <= kMostTriangles) return i;
    }
  };
  const auto poses = scenes::randomPoses(100 * count, 1, seed);
  std::vector<NodePair> pairs;
  for (fcl::Transform3d X : poses) {
    if (static_cast<int>(pairs.size()) == count) break;
    const int i = draw(a), j = draw(b);
    const MeshSplit::Node &m = a.nodes()[static_cast<std::size_t>(i)],
                          &n = b.nodes()[static_cast<std::size_t>(j)];
    const double size = std::max(m.extent, n.extent);
    if (std::min(m.extent, n.extent) < 0.3 * size) continue;
    const fcl::Vector3d at_a = a.corners(a.triangle(m.first))[0];
    const fcl::Vector3d at_b = b.corners(b.triangle(n.first))[0];
    const fcl::Vector3d apart = X.translation().normalized() * (2.5 * random.unit() * size);
    X.translation() = at_a + apart - X.linear() * at_b;
    const RelativePose<double> X_AB(X.linear(), X.translation());
    const double distance = distanceOf(a, m, b, n, X_AB);
    if (distance < 0.01 * size || distance > size) continue;
    pairs.push_back({i, j, X_AB, distance});
  }
  return pairs;
}

/// What is measured of an entrant.
struct Lane {
  FitEntrant* entrant;
  std::vector<double> build_us;
  std::vector<double> repeat_us;  // of one query, per frame
  std::vector<double> answers;
  std::size_t bv_tests = 0, leaf_tests = 0;
};

/// Asks all frames options.repeats times, the entrants taking turns at blocks of them.
void ask(bool collide, const Poses& poses, int repeats, std::vector<Lane>& lanes) {
  constexpr std::size_t kBlock = 64;
  for (Lane& lane : lanes) {
    lane.repeat_us.clear();
    lane.answers.assign(poses.size(), 0);
  }
  for (int repeat = 0; repeat < repeats; ++repeat) {
    for (Lane& lane : lanes) {
      lane.repeat_us.push_back(0);
      lane.bv_tests = lane.leaf_tests = 0;
    }
    for (std::size_t begin = 0, block = 0; begin < poses.size(); begin += kBlock, ++block) {
      for (std::size_t turn = 0; turn < lanes.size(); ++turn) {
        Lane& lane = lanes[(turn + block + static_cast<std::size_t>(repeat)) % lanes.size()];
        if (!collide && !lane.entrant->servesDistance()) continue;
        const double start = nowMicroseconds();
        for (std::size_t i = begin; i < std::min(begin + kBlock, poses.size()); ++i) {
          const VariantResult result =
              collide ? lane.entrant->collide(poses[i]) : lane.entrant->distance(poses[i]);
          lane.answers[i] = collide ? (result.contact ? 1 : 0) : result.distance;
          lane.bv_tests += static_cast<std::size_t>(result.bv_tests);
          lane.leaf_tests += static_cast<std::size_t>(result.leaf_tests);
        }
        lane.repeat_us.back() += nowMicroseconds() - start;
      }
    }
    for (Lane& lane : lanes) lane.repeat_us.back() /= static_cast<double>(poses.size());
  }
}

struct Bounds {
  double tightness = 0;   // mean of bound / true distance
  std::size_t wrong = 0;  // above the true distance
};

Bounds boundsOf(const FitEntrant& entrant, const std::vector<NodePair>& pairs) {
  constexpr double kRounding = 1e-12;
  Bounds bounds;
  for (const NodePair& pair : pairs) {
    const double bound = std::max(0.0, entrant.bound(pair));
    bounds.tightness += bound / pair.distance / static_cast<double>(pairs.size());
    if (bound > pair.distance * (1 + kRounding)) ++bounds.wrong;
  }
  return bounds;
}

void printHeading(const std::string& scenario, std::size_t frames) {
  std::printf("%s, %zu frames: distance | first contact | volumes\n", scenario.c_str(), frames);
  std::printf("%-24s %8s %8s %9s | %8s %7s %9s | %7s %6s %7s %6s %9s %5s\n", "volume", "BV tests",
              "leaves", "us", "BV tests", "leaves", "us", "us/tri", "k", "floats", "bytes",
              "tightness", "wrong");
}

void print(const FitEntrant& entrant, const Row* distance, const Row& collide, std::size_t wrong) {
  std::printf("%-24s ", entrant.name().c_str());
  if (distance) {
    std::printf("%8.1f %8.1f %9.2f |", *distance->bv_tests, *distance->leaf_tests,
                distance->median_us);
  } else {
    std::printf("%8s %8s %9s |", "-", "-", "-");
  }
  std::printf(" %8.1f %7.1f %9.2f | %7.2f %6.2f %7.2f %6.0f ", *collide.bv_tests,
              *collide.leaf_tests, collide.median_us, *collide.build_us_per_triangle,
              entrant.spheres(), *collide.floats_per_bv, entrant.bytes());
  if (collide.tightness) {
    std::printf("%9.3f", *collide.tightness);
  } else {
    std::printf("%9s", "-");
  }
  std::printf(" %5zu\n", wrong);
}

std::vector<Lane> built(const std::vector<std::unique_ptr<FitEntrant>>& entrants,
                        const FitEntrant::Split& a, const FitEntrant::Split& b, int repeats) {
  std::vector<Lane> lanes;
  for (const auto& entrant : entrants) {
    Lane lane{entrant.get(), {}, {}, {}, 0, 0};
    for (int repeat = 0; repeat < repeats; ++repeat) {
      const double start = nowMicroseconds();
      entrant->build(a, b);
      lane.build_us.push_back(nowMicroseconds() - start);
    }
    lanes.push_back(lane);
  }
  return lanes;
}

/// What ask() and built() measured of a lane.
Row rowOf(const Lane& lane, const Scene& scene, Query query) {
  const auto triangles = scene.a.triangles.size() + scene.b.triangles.size();
  const auto frames = static_cast<double>(lane.answers.size());
  Row row;
  row.scenario = scene.name;
  row.query = name(query);
  row.bv = lane.entrant->name();
  row.triangles = triangles;
  row.frames = lane.answers.size();
  row.median_us = median(lane.repeat_us);
  row.min_us = *std::min_element(lane.repeat_us.begin(), lane.repeat_us.end());
  row.bv_tests = static_cast<double>(lane.bv_tests) / frames;
  row.leaf_tests = static_cast<double>(lane.leaf_tests) / frames;
  row.build_us_per_triangle = median(lane.build_us) / static_cast<double>(triangles);
  row.floats_per_bv = lane.entrant->numbers();
  row.bytes_per_triangle = 2 * lane.entrant->bytes();  // of volumes
  if (lane.entrant->spheres() > 0) row.mean_spheres = lane.entrant->spheres();
  row.extent = std::max(scenes::extent(scene.a), scenes::extent(scene.b));
  return row;
}

void printTable(const std::string& scenario,
                const std::vector<std::unique_ptr<FitEntrant>>& entrants,
                const std::vector<Row>& rows) {
  printHeading(scenario, rows.front().frames);
  for (const auto& entrant : entrants) {
    const auto find = [&](const char* query) {
      return std::find_if(rows.begin(), rows.end(), [&](const Row& row) {
        return row.bv == entrant->name() && row.query == query;
      });
    };
    const auto distance = find("distance"), collide = find("collide");
    const bool has_distance = distance != rows.end();
    print(*entrant, has_distance ? &*distance : nullptr, *collide,
          *collide->wrong_verdicts + (has_distance ? *distance->wrong_verdicts : 0));
  }
  std::printf("\n");
}

void reportScene(const Scene& scene, const Options& options, Report& report) {
  const std::vector<scenes::Frame> frames = chosenFrames(scene.frames, options);
  Poses poses;
  for (const scenes::Frame& frame : frames) poses.emplace_back(frame.X_WA, frame.X_WB);
  const auto a = std::make_shared<MeshSplit>(scene.a.vertices, scene.a.triangles);
  const auto b = std::make_shared<MeshSplit>(scene.b.vertices, scene.b.triangles);
  const auto nodes = sampleNodes(*a, *b, options.quick ? 100 : 1000, options.seed);
  const scenes::MeshOracle oracle(scene.a, scene.b);
  const auto entrants = fitEntrants();
  std::vector<Lane> lanes = built(entrants, a, b, options.repeats);

  std::vector<Row> rows;
  for (const Query query : {Query::kDistance, Query::kCollide}) {
    ask(query == Query::kCollide, poses, options.repeats, lanes);
    const std::vector<Question> questions = pairTask("", query, frames).questions;
    const Verdicts verdicts =
        judge([&oracle](std::size_t, std::size_t) -> const scenes::MeshOracle& { return oracle; },
              query, questions, options.oracle_frames);
    for (const Lane& lane : lanes) {
      if (query == Query::kDistance && !lane.entrant->servesDistance()) continue;
      Row row = rowOf(lane, scene, query);
      row.seed = options.seed;
      compare(lane.answers, verdicts, query, questions, row.extent, row);
      if (lane.entrant->servesDistance()) {
        const Bounds bounds = boundsOf(*lane.entrant, nodes);
        row.tightness = bounds.tightness;
        *row.wrong_verdicts += bounds.wrong;
      }
      rows.push_back(row);
    }
  }
  printTable(scene.name, entrants, rows);
  report.addUnprinted(rows);
}

}  // namespace

void runFits(const Options& options, Report& report) {
  constexpr int kFrames = 200;
  Options ours = options;
  if (ours.frames == 0) ours.frames = options.quick ? 10 : kFrames;
  if (const auto data = findData(options); data && !options.quick) {
    const scenes::MovingPair falling = scenes::loadFalling(*data);
    reportScene({"fits/falling", falling.a, falling.b, falling.frames}, ours, report);
    const scenes::MovingPair spinning = scenes::loadSpinning(*data, 2400);
    reportScene({"fits/spinning", spinning.a, spinning.b, spinning.frames}, ours, report);
  }
  constexpr int kMotion = 1200;
  reportScene({"fits/falling_generated", scenes::bentTorus(), scenes::knobbyTorus(),
               scenes::fallingMotion(kMotion)},
              ours, report);
  if (options.quick) return;
  reportScene({"fits/spinning_generated", scenes::bumpyBlob(), scenes::bentTorus(),
               scenes::spinningMotion(kMotion)},
              ours, report);
}

}  // namespace kios::bench
