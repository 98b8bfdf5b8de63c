// SPDX-FileCopyrightText: 2026 The fcl_kios authors
// SPDX-License-Identifier: BSD-3-Clause
//
// Table I and Figures 5 and 6 of Zhang & Kim, "k-IOS: Intersection of Spheres for Efficient
// Proximity Query". Its SSV is PQP, whose volume for distances is FCL's RSS; for collisions PQP
// tests OBBs, as FCL's OBBRSS does.

#include <algorithm>
#include <cstdio>
#include <memory>
#include <string>
#include <vector>

#include "contest.h"
#include "fcl_kios/model/model.h"
#include "fcl_kios/paper/fit.h"
#include "scenario.h"
#include "scenes/robots.h"
#include "scenes/shapes.h"
#include "scenes/ur5_data.h"

namespace kios::bench {
namespace {

constexpr char kSsv[] = "fcl_rss_tree";
constexpr double kFloatsOfRss = 15;  // axes, corner, two lengths, radius

/// Counts the spheres of a mesh's nodes, and the floats that the paper stores for them: centre and
/// radius of S0, the centres of the others and one radius that these share. With radii of their
/// own, there would be 4 k floats.
struct Spheres {
  double nodes = 0, leaves = 0;
  double spheres = 0, floats = 0, floats_of_leaves = 0;

  void add(const scenes::Mesh& mesh, FitMethod method) {
    const auto model =
        scenes::buildModel<kIOSd>(mesh, std::make_shared<PaperFitter<double>>(method));
    for (int i = 0; i < model->getNumBVs(); ++i) {
      const int k = model->getBV(i).bv.k();
      const bool shared = method == FitMethod::kMethodII && k > 1;
      const int own = shared ? 4 + 3 * (k - 1) + 1 : 4 * k;
      nodes += 1;
      spheres += k;
      floats += own;
      if (!model->getBV(i).isLeaf()) continue;
      leaves += 1;
      floats_of_leaves += own;
    }
  }
};

const char* meaning(const std::string& bv) {
  if (bv == "kios_method_ii") return "k-IOS, Method II as published";
  if (bv == "kios_tree") return "k-IOS, tuned fit";
  if (bv == "kios") return "k-IOS, the engine";
  if (bv == kSsv) return "SSV: FCL's RSS";
  return "FCL's OBBRSS";
}

/// Adds what only the paper's table has, and prints that table.
void reportInPaperUnits(const std::vector<scenes::Mesh>& meshes, std::vector<Row> rows,
                        Report& report) {
  Spheres published, tuned;
  for (const scenes::Mesh& mesh : meshes) {
    published.add(mesh, FitMethod::kMethodII);
    tuned.add(mesh, FitMethod::kTuned);
  }
  std::printf("%-24s %-9s %-30s %10s %8s %9s %9s %8s %6s %7s %6s\n", "scene", "query", "BV", "ms",
              "SSV / BV", "greatest", "BV tests", "as paper", "k", "floats", "wrong");
  for (Row& row : rows) {
    const auto ssv = std::find_if(rows.begin(), rows.end(), [&row](const Row& other) {
      return other.bv == kSsv && other.query == row.query;
    });
    row.to_ssv.ratio = ssv->times.median_us / row.times.median_us;
    Volumes& volumes = row.volumes;
    if (row.bv == kSsv) volumes.floats_per_bv = kFloatsOfRss;
    if (row.bv == "kios_method_ii" || row.bv == "kios_tree") {
      const Spheres& of = row.bv == "kios_tree" ? tuned : published;
      volumes.mean_spheres = of.spheres / of.nodes;
      volumes.floats_per_bv = of.floats / of.nodes;
    }
    // The tests of both children of a node count as one in the paper's distances (inferred).
    const double tests = *row.tests.bvs / (row.query == "distance" && row.bv != "kios" ? 2 : 1);
    std::printf("%-24s %-9s %-30s %10.5f %8.2f %9s %9.1f %8.1f %6s %7s %6zu\n",
                row.scenario.c_str(), row.query.c_str(), meaning(row.bv),
                row.times.median_us / 1000, *row.to_ssv.ratio,
                cell(row.to_ssv.max_ratio, "%.2f").c_str(), *row.tests.bvs, tests,
                cell(volumes.mean_spheres, "%.2f").c_str(),
                cell(volumes.floats_per_bv, "%.2f").c_str(), *row.errors.wrong);
  }
  const auto inner = [](const Spheres& of) {
    return (of.floats - of.floats_of_leaves) / (of.nodes - of.leaves);
  };
  std::printf("floats a BV, leaves / inner nodes: published %.2f / %.2f, tuned %.2f / %.2f\n\n",
              published.floats_of_leaves / published.leaves, inner(published),
              tuned.floats_of_leaves / tuned.leaves, inner(tuned));
  report.addUnprinted(rows);
}

void reportFigure5(const std::string& scenario, const scenes::MovingPair& pair,
                   const Options& options, Report& report) {
  Contest contest({pair.a, pair.b}, options);
  std::vector<Row> rows;
  for (const Query query : {Query::kCollide, Query::kDistance}) {
    append(contest.queryRows(pairTask(scenario, query, chosenFrames(pair.frames, options))), rows);
  }
  reportInPaperUnits({pair.a, pair.b}, rows, report);
}

/// In each frame the 33 nearest pairs of a link of one robot and a link of the other, their bases
/// left out: the paper tracks 33 "links" and leaves out stationary ones and those far apart.
Task nearestPairs(const scenes::Robot& robot, const std::vector<scenes::Mesh>& meshes,
                  const fcl::Transform3d& X_W2, int frames, const Options& options) {
  constexpr int kMotionFrames = 400;
  constexpr std::size_t kPairs = 33;
  const auto first = scenes::jointMotion(robot, kMotionFrames, true, 2 * options.seed);
  const auto second = scenes::jointMotion(robot, kMotionFrames, true, 2 * options.seed + 1);
  const auto kios = makeMeshSet("kios");
  kios->load(meshes);
  Task task;
  for (int i = 0; i < frames; ++i) {
    const int frame = i * kMotionFrames / frames;
    const auto poses_1 = scenes::robotPoses(robot, fcl::Transform3d::Identity(), first[frame]);
    const auto poses_2 = scenes::robotPoses(robot, X_W2, second[frame]);
    std::vector<Question> all;
    for (std::size_t a = 1; a < poses_1.size(); ++a) {
      for (std::size_t b = 1; b < poses_2.size(); ++b) {
        all.push_back({a, b, {poses_1[a], poses_2[b]}});
      }
    }
    std::vector<double> distances(all.size());
    kios->answer(Query::kDistance, all, 0, all.size(), distances);
    std::vector<std::size_t> order(all.size());
    for (std::size_t q = 0; q < order.size(); ++q) order[q] = q;
    std::partial_sort(order.begin(), order.begin() + kPairs, order.end(),
                      [&](std::size_t p, std::size_t q) { return distances[p] < distances[q]; });
    for (std::size_t q = 0; q < kPairs; ++q) task.questions.push_back(all[order[q]]);
  }
  task.query = Query::kDistance;
  task.frames = frames;
  return task;
}

void reportFigure6(const std::string& scenario, const scenes::Robot& robot, double apart,
                   const Options& options, Report& report) {
  constexpr int kFrames = 60;
  const int frames = options.frames > 0 ? options.frames : (options.quick ? 2 : kFrames);
  fcl::Transform3d X_facing = fcl::Transform3d::Identity();
  X_facing.linear() = fcl::Vector3d(-1, -1, 1).asDiagonal();
  X_facing.translation().x() = apart;
  std::vector<scenes::Mesh> meshes;
  for (const scenes::Link& link : robot.links) meshes.push_back(link.mesh);
  Task task = nearestPairs(robot, meshes, X_facing, frames, options);
  task.scenario = scenario;
  Contest contest(meshes, options);
  std::vector<Row> rows = contest.queryRows(task);
  auto times = contest.frameTimes(task);
  for (Row& row : rows) {
    double greatest = 0;
    for (std::size_t i = 0; i < task.frames; ++i) {
      greatest = std::max(greatest, times[kSsv][i] / times[row.bv][i]);
    }
    row.to_ssv.max_ratio = greatest;
  }
  reportInPaperUnits(meshes, rows, report);
}

/// Returns the robot with ellipsoids of well-shaped triangles in place of its links, in the same
/// boxes.
scenes::Robot rounded(scenes::Robot robot) {
  for (scenes::Link& link : robot.links) {
    fcl::AABBd box;
    for (const fcl::Vector3d& p : link.mesh.vertices) box += p;
    const fcl::Vector3d half = (box.max_ - box.min_) / 2;
    link.mesh = scenes::icosphere(1, 3);
    for (fcl::Vector3d& p : link.mesh.vertices) p = box.center() + half.cwiseProduct(p);
  }
  return robot;
}

}  // namespace

void runPaper(const Options& options, Report& report) {
  Options ours = options;
  ours.bvs = {"kios_method_ii", "kios_tree", "kios", kSsv, "fcl_obbrss"};
  const auto data = options.quick ? std::nullopt : findData(options);
  if (data) {
    constexpr int kSpinningFrames = 2400;
    reportFigure5("paper/falling", scenes::loadFalling(*data), ours, report);
    reportFigure5("paper/spinning", scenes::loadSpinning(*data, kSpinningFrames), ours, report);
  } else {
    std::printf("generated shapes stand in for the PQP data, which --data or KIOS_DATA names\n");
    reportFigure5("paper/falling_generated", generatedFalling(), ours, report);
    reportFigure5("paper/spinning_generated", generatedSpinning(), ours, report);
  }
  if (data && scenes::holdsUr5(*data)) {
    reportFigure6("paper/arms_ur5", scenes::robotOf(scenes::loadUr5(*data)), 0.7, ours, report);
  }
  reportFigure6("paper/arms", scenes::robotOf(scenes::cadArm()), 0.7, ours, report);
  if (options.quick) return;
  reportFigure6("paper/humanoids", scenes::humanoid(), 0.8, ours, report);
  reportFigure6("paper/humanoids_rounded", rounded(scenes::humanoid()), 0.8, ours, report);
}

}  // namespace kios::bench
