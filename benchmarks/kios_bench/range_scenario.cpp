// SPDX-FileCopyrightText: 2026 The fcl_kios authors
// SPDX-License-Identifier: BSD-3-Clause
//
// The least clearance over ranges of joints: a door on its hinge, paths of an arm in its cell, two
// of its joints over their whole ranges; and the width of the bracket by the queries that it may
// take.
#include <algorithm>
#include <cmath>
#include <functional>

#include "fcl_kios/linkage.h"
#include "fcl_kios/model.h"
#include "motion_set.h"
#include "scenario.h"
#include "scenes/placement.h"
#include "scenes/shapes.h"

namespace kios::bench {
namespace {

using Eigen::VectorXd;
using Ask = std::function<RangeResult(std::size_t task, const RangeRequest& request)>;

/// Times `ask` for all tasks, and beside it `samples` for a few of them.
void reportRange(const std::string& name, std::size_t tasks, const RangeRequest& request,
                 const Ask& ask, const Options& options, Report& report,
                 const std::function<void(std::size_t)>& samples = nullptr) {
  std::vector<RangeResult> found(tasks);
  std::vector<Competitor> competitors = {
      {"kios", each([&](std::size_t i) { found[i] = ask(i, request); })}};
  competitors[0].answer(0, tasks);
  if (samples) {
    competitors.push_back({"fcl_obbrss_samples", each(samples)});
    competitors.back().stride = 20;
  }
  Race{tasks, options.repeats, Race::kAll, 1}.run(competitors);
  const Row base = baseRow("motions/range/" + name, "range", tasks);
  std::vector<Row> rows;
  for (const Competitor& competitor : competitors) {
    Row row = base;
    row.frames = (tasks + competitor.stride - 1) / competitor.stride;
    rows.push_back(row.of(competitor));
    if (competitor.name != "kios") continue;
    double width = 0, queries = 0;
    for (const RangeResult& result : found) {
      width += result.upper - result.lower;
      queries += static_cast<double>(result.queries);
    }
    rows.back().errors.bracket_width = width / static_cast<double>(tasks);
    rows.back().pairs.narrow_queries = queries / static_cast<double>(tasks);
    if (request.max_queries != RangeRequest().max_queries) {
      rows.back().asked.budget = static_cast<double>(request.max_queries);
    }
  }
  report.add(rows);
}

std::shared_ptr<Modeld> boxOf(const fcl::Vector3d& size, int n) {
  const scenes::Mesh mesh = scenes::subdividedBox(size, n);
  return makeModel(mesh.vertices, mesh.triangles);
}

/// A leaf of 20,000 triangles between two jambs and under a lintel.
void reportDoor(double gap, const Options& options, Report& report) {
  Linkage door;
  Joint hinge;
  hinge.type = JointType::kRevolute;
  const auto at = [](double x, double z) {
    return fcl::Transform3d(Eigen::Translation3d(x, 0, z));
  };
  door.addBody(door.addLink(-1, hinge), boxOf({0.9, 0.04, 2}, options.quick ? 4 : 41),
               at(0.452, 0));
  const auto jamb = boxOf({0.1, 0.1, 2.1}, 8);
  door.addBody(-1, jamb, at(0.952 + gap, 0));
  door.addBody(-1, jamb, at(-0.1, 0));
  door.addBody(-1, boxOf({1.2, 0.1, 0.1}, 8), at(0.45, 1.05 + gap));
  RangeRequest request;
  request.abs_err = 0;
  const JointBox swing{{0}, {1.6}};
  const Ask ask = [&](std::size_t /*task*/, const RangeRequest& asked) {
    return leastClearance(door, swing, asked);
  };
  char name[32];
  std::snprintf(name, sizeof name, "door/%g", gap);
  reportRange(name, 1, request, ask, options, report);
  for (const long long most : {20, 40, 60, 80, 100, 150, 200}) {
    request.max_queries = most;
    reportRange(std::string(name) + "/budget", 1, request, ask, options, report);
  }
}

/// Free paths to a millimetre, and pairs of joints over a whole turn each.
void reportArm(const std::string& name, const scenes::Cell& cell, const Options& options,
               Report& report) {
  const Linkage linkage = linkageOf(cell);
  scenes::Random random(options.seed);
  std::vector<std::pair<VectorXd, VectorXd>> paths;
  std::vector<std::pair<scenes::Joints, scenes::Joints>> sampled;
  const std::size_t count = options.quick ? 3 : 40;
  for (int tries = 0; tries < 10000 && paths.size() < count; ++tries) {
    const scenes::Joints q = scenes::randomJoints(cell, random);
    const scenes::Joints to = scenes::randomStep(q, 0.8, random);
    const VectorXd q0 = vectorOf(q), q1 = vectorOf(to);
    if (checkMotion(linkage, q0, q1).verdict != MotionVerdict::kClear) continue;
    paths.emplace_back(q0, q1);
    sampled.emplace_back(q, to);
  }
  constexpr double kError = 1e-3;  // nothing is farther from the nearest sample
  const auto samples = makeSampledClearance(cell, options.quick ? 0.1 : 2 * kError);
  RangeRequest request;
  request.abs_err = kError;
  request.rel_err = 0;
  reportRange(
      name + "/path", paths.size(), request,
      [&](std::size_t i, const RangeRequest& asked) {
        return leastClearance(linkage, paths[i].first, paths[i].second, asked);
      },
      options, report, [&](std::size_t i) { samples(sampled[i].first, sampled[i].second); });
  const std::size_t joints = static_cast<std::size_t>(cell.coordinates());
  reportRange(
      name + "/box", joints - 1, RangeRequest(),
      [&](std::size_t i, const RangeRequest& asked) {
        const VectorXd& q = paths[i % paths.size()].first;
        JointBox box{{q.data(), q.data() + q.size()}, {q.data(), q.data() + q.size()}};
        for (const std::size_t k : {i, i + 1}) {
          box.lower[k] = -scenes::kPi;
          box.upper[k] = scenes::kPi;
        }
        return leastClearance(linkage, box, asked);
      },
      options, report);
}

}  // namespace

void reportRanges(const Options& options, Report& report) {
  for (const double gap : {0.05, 0.005}) reportDoor(gap, options, report);
  const auto ur5 = findUr5(options);
  const scenes::Robot robot = ur5 ? *ur5 : scenes::cadArm();
  reportArm(ur5 ? "ur5" : "arm",
            scenes::workCell(robot, 20, options.quick ? 0.05 : 1, options.seed), options, report);
}

}  // namespace kios::bench
