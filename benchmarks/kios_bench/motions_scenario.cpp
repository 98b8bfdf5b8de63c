// SPDX-FileCopyrightText: 2026 The fcl_kios authors
// SPDX-License-Identifier: BSD-3-Clause
//
// Straight paths in the joint space of robots: proven by checkMotion(), and sampled.
#include <algorithm>
#include <cstdio>

#include "library.h"
#include "motion_set.h"
#include "scenario.h"
#include "scenes/placement.h"

namespace kios::bench {
namespace {

using scenes::Joints;

struct Edge {
  Joints q0, q1;
};

constexpr double kLengths[] = {0.05, 0.2, 0.8};

struct Entrant {
  std::string name;
  std::unique_ptr<MotionSet> set;
};

std::vector<Entrant> entrantsIn(const scenes::Cell& cell) {
  std::vector<Entrant> entrants;
  for (const std::string& name : compared({kOurs, "sampled_kios", "fcl_obbrss"})) {
    entrants.push_back(
        {name, isOurs(name) ? libraryOf(name).motion_set(cell) : makeMotionSet(name, cell)});
  }
  return entrants;
}

/// Holds the truth: an exact static query at so many configurations, and of those that
/// checkMotion() names.
class Oracle {
 public:
  explicit Oracle(const scenes::Cell& cell)
      : linkage_(linkageOf(cell)), free_(makeStaticCheck(cell)) {}

  bool isFreeAt(const Joints& q) const { return free_(q); }
  /// Returns false if one of `samples` + 1 configurations from q0 to q1 is in contact, or one
  /// between them that a contact is said to be in.
  bool isFree(const Edge& edge, int samples) const {
    for (int i = 0; i <= samples; ++i) {
      if (!free_(scenes::between(edge.q0, edge.q1, 1.0 * i / samples))) return false;
    }
    const MotionResult answer = checkMotion(linkage_, vectorOf(edge.q0), vectorOf(edge.q1));
    if (answer.verdict != MotionVerdict::kContact) return true;
    return free_(scenes::between(edge.q0, edge.q1, answer.to));
  }

 private:
  const Linkage linkage_;
  const std::function<bool(const Joints&)> free_;
};

/// Returns a path of this length from a free configuration.
Edge drawEdge(const scenes::Cell& cell, const Oracle& oracle, double length,
              scenes::Random& random) {
  Edge edge;
  do {
    edge.q0 = scenes::randomJoints(cell, random);
    edge.q1 = scenes::randomStep(edge.q0, length, random);
  } while (!oracle.isFreeAt(edge.q0));
  return edge;
}

/// Is as many of either kind, if there are so many among many.
struct Edges {
  std::vector<Edge> free, blocked;
};

Edges drawEdges(const scenes::Cell& cell, const Oracle& oracle, double length, int count,
                int samples, std::uint64_t seed) {
  scenes::Random random(seed);
  Edges edges;
  const auto wanted = static_cast<std::size_t>(count);
  for (int tries = 0; tries < 100 * count; ++tries) {
    if (edges.free.size() >= wanted && edges.blocked.size() >= wanted) break;
    const Edge edge = drawEdge(cell, oracle, length, random);
    auto& kind = oracle.isFree(edge, samples) ? edges.free : edges.blocked;
    if (kind.size() < wanted) kind.push_back(edge);
  }
  return edges;
}

Row rowOf(const std::string& scenario, const scenes::Cell& cell, std::size_t edges) {
  Row row = baseRow(scenario, "motion", edges);
  for (int body = 0; body < cell.bodies(); ++body) {
    row.triangles += cell.mesh(body).triangles.size();
  }
  return row;
}

/// Reports how many contacts each set misses; not timed.
void reportMissed(const std::string& scenario, const scenes::Cell& cell, const Oracle& oracle,
                  double length, int count, int samples, const Options& options, Report& report) {
  scenes::Random random(options.seed + 1);
  std::vector<Edge> edges;
  std::vector<char> free;
  for (int i = 0; i < count; ++i) {
    edges.push_back(drawEdge(cell, oracle, length, random));
    free.push_back(oracle.isFree(edges.back(), samples) ? 1 : 0);
  }
  std::vector<Row> rows;
  for (const auto& [name, set] : entrantsIn(cell)) {
    int missed = 0;
    for (std::size_t i = 0; i < edges.size(); ++i) {
      missed += set->isFree(edges[i].q0, edges[i].q1) && free[i] == 0 ? 1 : 0;
    }
    Row row = rowOf(scenario, cell, edges.size());
    row.bv = name;
    row.errors.wrong = static_cast<std::size_t>(missed);
    rows.push_back(row);
  }
  report.add(rows);
}

void reportEdges(const std::string& scenario, const scenes::Cell& cell,
                 const std::vector<Edge>& edges, bool free, const Options& options,
                 Report& report) {
  if (edges.empty()) return;
  const std::vector<Entrant> entrants = entrantsIn(cell);
  std::vector<Competitor> competitors;
  std::vector<std::vector<char>> verdicts(entrants.size(), std::vector<char>(edges.size(), 0));
  for (std::size_t i = 0; i < entrants.size(); ++i) {
    const auto& [name, set] = entrants[i];
    competitors.push_back({name, each([&of_set = verdicts[i], &edges, &set = *set](std::size_t e) {
                             of_set[e] = set.isFree(edges[e].q0, edges[e].q1) ? 1 : 0;
                           })});
    competitors.back().rounds = roundsOf(name);
  }
  Race race{edges.size(), options.repeats, 20};
  race.warm_up = true;
  race.run(competitors);
  const Row base = rowOf(scenario, cell, edges.size());
  std::vector<Row> rows;
  const auto asked = static_cast<double>(edges.size()) * (options.repeats + 1);
  for (std::size_t i = 0; i < entrants.size(); ++i) {
    Row row = base.of(competitors[i], named("fcl_obbrss", competitors));
    // Contacts that were missed, and contacts that no sample of the oracle confirms.
    row.errors.wrong = std::count(verdicts[i].begin(), verdicts[i].end(), free ? 0 : 1);
    row.pairs.narrow_queries = static_cast<double>(entrants[i].set->takeQueried()) / asked;
    rows.push_back(row);
    if (const long long open = entrants[i].set->takeUnresolved(); open > 0) {
      std::printf("%s: %lld of %.0f unresolved\n", scenario.c_str(), open, asked);
    }
  }
  report.add(rows);
}

void reportCell(const std::string& name, const scenes::Cell& cell, const Options& options,
                Report& report) {
  const int count = options.frames > 0 ? options.frames : (options.quick ? 10 : 200);
  const int judged = options.quick ? 20 : options.oracle_frames;
  const int samples = options.quick ? 100 : 400;
  const Oracle oracle(cell);
  for (const double length : kLengths) {
    const Edges edges = drawEdges(cell, oracle, length, count, samples, options.seed);
    char suffix[32];
    std::snprintf(suffix, sizeof suffix, "/%g", length);
    reportEdges(name + "/valid" + suffix, cell, edges.free, true, options, report);
    reportEdges(name + "/invalid" + suffix, cell, edges.blocked, false, options, report);
    reportMissed(name + "/missed" + suffix, cell, oracle, length, judged, 10 * samples, options,
                 report);
  }
}

}  // namespace

void runMotions(const Options& options, Report& report) {
  if (wanted(options, "range")) reportRanges(options, report);
  if (wanted(options, "moved")) reportMoved(options, report);
  if (wanted(options, "continuous")) reportContinuous(options, report);
  if (!wanted(options, "paths")) return;
  const auto ur5 = findUr5(options);
  const scenes::Robot robot = ur5 ? *ur5 : scenes::cadArm();
  const std::string kind = ur5 ? "ur5" : "arm";
  reportCell("motions/" + kind + "_cell",
             scenes::workCell(robot, 20, options.quick ? 0.05 : 1, options.seed), options, report);
  const fcl::Transform3d X_W2 = ur5 ? scenes::shift(0, 0.5, 0) : scenes::facing(0.7);
  reportCell("motions/" + kind + "_pair", scenes::sideBySide(robot, X_W2), options, report);
}

}  // namespace kios::bench
