// SPDX-FileCopyrightText: 2026 The fcl_kios authors
// SPDX-License-Identifier: BSD-3-Clause
//
// Straight paths in the joint space of robots: proven by checkMotion(), and sampled.
#include <cmath>
#include <cstdio>
#include <algorithm>

#include "motion_set.h"
#include "scenario.h"
#include "scenes/ur5_data.h"

namespace kios::bench {
namespace {

using scenes::Joints;

struct Edge {
  Joints q0, q1;
};

constexpr double kLengths[] = {0.05, 0.2, 0.8};
constexpr const char* kSets[] = {"kios", "kios_sampled", "kios_scene_sampled", "fcl_obbrss"};

/// The paths of one length from free configurations, and the truth as far as samples tell it.
struct Edges {
  std::vector<Edge> free, blocked;
};

/// The truth: a static query, by FCL's call, of every pair at so many configurations.
class Oracle {
 public:
  explicit Oracle(const scenes::Cell& cell) : linkage_(linkageOf(cell)) {}

  /// The number of `samples` + 1 configurations from q0 to q1 that are in contact.
  int contacts(const Edge& edge, int samples) const {
    int count = 0;
    for (int i = 0; i <= samples; ++i) {
      count += touches(scenes::between(edge.q0, edge.q1, 1.0 * i / samples)) ? 1 : 0;
    }
    return count;
  }
  /// By a path of no length, which asks each pair once.
  bool touches(const Joints& q) const {
    const auto x = Eigen::Map<const Eigen::VectorXd>(q.data(), static_cast<Eigen::Index>(q.size()));
    return checkMotion(linkage_, x, x).verdict != MotionVerdict::kClear;
  }

 private:
  const Linkage linkage_;
};

Edges drawEdges(const scenes::Cell& cell, const Oracle& oracle, double length, int count,
                int samples, std::uint64_t seed) {
  scenes::Random random(seed);
  Edges edges;
  const auto wanted = static_cast<std::size_t>(count);
  for (int tries = 0; tries < 400 * count; ++tries) {
    if (edges.free.size() >= wanted && edges.blocked.size() >= wanted) break;
    Edge edge;
    edge.q0 = scenes::randomJoints(cell, random);
    edge.q1 = scenes::randomStep(edge.q0, length, random);
    if (oracle.touches(edge.q0)) continue;
    auto& kind = oracle.contacts(edge, samples) > 0 ? edges.blocked : edges.free;
    if (kind.size() < wanted) kind.push_back(edge);
  }
  return edges;
}

void reportEdges(const std::string& scenario, const scenes::Cell& cell,
                 const std::vector<Edge>& edges, bool free, const Options& options,
                 Report& report) {
  if (edges.empty()) return;
  std::vector<std::unique_ptr<MotionSet>> sets;
  std::vector<Competitor> competitors;
  std::vector<std::vector<char>> verdicts;
  for (const char* name : kSets) {
    sets.push_back(makeMotionSet(name, cell));
    verdicts.emplace_back(edges.size(), 0);
  }
  for (std::size_t i = 0; i < sets.size(); ++i) {
    competitors.push_back({sets[i]->name(), [&, i](std::size_t begin, std::size_t end) {
                             for (std::size_t e = begin; e < end; ++e) {
                               verdicts[i][e] = sets[i]->isFree(edges[e].q0, edges[e].q1) ? 1 : 0;
                             }
                           }});
  }
  Race race{edges.size(), options.repeats, 20};
  race.warm_up = true;
  race.run(competitors);
  Row base;
  base.scenario = scenario;
  base.query = "motion";
  base.frames = edges.size();
  base.seed = options.seed;
  for (int body = 0; body < cell.bodies(); ++body) {
    base.triangles += cell.mesh(body).triangles.size();
  }
  std::vector<Row> rows;
  const auto asked = static_cast<double>(edges.size()) * (options.repeats + 1);
  for (std::size_t i = 0; i < sets.size(); ++i) {
    Row row = base.of(competitors[i], named("fcl_obbrss", competitors));
    // Contacts that were missed, and contacts that no sample of the oracle confirms.
    row.errors.wrong = std::count(verdicts[i].begin(), verdicts[i].end(), free ? 0 : 1);
    row.pairs.narrow_queries = static_cast<double>(sets[i]->takeQueried()) / asked;
    rows.push_back(row);
    if (const long long open = sets[i]->takeUnresolved(); open > 0) {
      std::printf("%s: %lld of %.0f unresolved\n", scenario.c_str(), open, asked);
    }
  }
  report.add(rows);
  for (const Row& row : rows) {
    std::printf("  %-20s narrow queries an edge: %.2f\n", row.bv.c_str(), *row.pairs.narrow_queries);
  }
}

void reportCell(const std::string& name, const scenes::Cell& cell, const Options& options,
                Report& report) {
  const int count = options.frames > 0 ? options.frames : (options.quick ? 10 : 200);
  const Oracle oracle(cell);
  for (const double length : kLengths) {
    const int samples = options.quick ? 100 : 400;
    const Edges edges = drawEdges(cell, oracle, length, count, samples, options.seed);
    char suffix[32];
    std::snprintf(suffix, sizeof suffix, "/%g", length);
    reportEdges(name + "/valid" + suffix, cell, edges.free, true, options, report);
    reportEdges(name + "/invalid" + suffix, cell, edges.blocked, false, options, report);
  }
}

}  // namespace

void runMotions(const Options& options, Report& report) {
  const auto data = findData(options);
  const bool ur5 = data && scenes::holdsUr5(*data);
  const scenes::Robot robot = scenes::robotOf(ur5 ? scenes::loadUr5(*data) : scenes::cadArm());
  const std::string kind = ur5 ? "ur5" : "arm";
  reportCell("motions/" + kind + "_cell",
             scenes::workCell(robot, 20, options.quick ? 0.05 : 1, options.seed), options, report);
  fcl::Transform3d X_W2 = fcl::Transform3d::Identity();
  if (ur5) {
    X_W2.translation().y() = 0.5;
  } else {
    X_W2.linear() = fcl::Vector3d(-1, -1, 1).asDiagonal();
    X_W2.translation().x() = 0.7;
  }
  reportCell("motions/" + kind + "_pair", scenes::sideBySide(robot, X_W2), options, report);
}

}  // namespace kios::bench
