// SPDX-FileCopyrightText: 2026 The fcl_kios authors
// SPDX-License-Identifier: BSD-3-Clause
//
// Figure 6 of Zhang & Kim, "k-IOS: Intersection of Spheres for Efficient Proximity Query". Its SSV
// is PQP, whose volume for distances is FCL's RSS.

#include <algorithm>
#include <string>
#include <vector>

#include "contest.h"
#include "scenario.h"
#include "scenes/robots.h"
#include "scenes/shapes.h"
#include "scenes/ur5_data.h"

namespace kios::bench {
namespace {

constexpr char kSsv[] = "fcl_rss_tree";

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

void reportArms(const std::string& scenario, const scenes::Robot& robot, double apart,
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
  const auto ssv =
      std::find_if(rows.begin(), rows.end(), [](const Row& r) { return r.bv == kSsv; });
  auto times = contest.frameTimes(task);
  for (Row& row : rows) {
    double greatest = 0;
    for (std::size_t i = 0; i < task.frames; ++i) {
      greatest = std::max(greatest, times[kSsv][i] / times[row.bv][i]);
    }
    row.to_ssv.max_ratio = greatest;
    row.to_ssv.ratio = ssv->times.median_us / row.times.median_us;
  }
  report.add(rows);
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

void reportFigure6(const Options& options, Report& report) {
  Options ours = options;
  ours.bvs = {"kios_method_ii", "kios_tree", "kios", kSsv};
  if (const auto data = findData(options); data && scenes::holdsUr5(*data) && !options.quick) {
    reportArms("paper/arms_ur5", scenes::robotOf(scenes::loadUr5(*data)), 0.7, ours, report);
  }
  reportArms("paper/arms", scenes::robotOf(scenes::cadArm()), 0.7, ours, report);
  if (options.quick) return;
  reportArms("paper/humanoids", scenes::humanoid(), 0.8, ours, report);
  reportArms("paper/humanoids_rounded", rounded(scenes::humanoid()), 0.8, ours, report);
}

}  // namespace kios::bench
