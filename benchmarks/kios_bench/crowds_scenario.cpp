// SPDX-FileCopyrightText: 2026 The fcl_kios authors
// SPDX-License-Identifier: BSD-3-Clause
//
// Many different small bodies in FCL's manager: made and asked about, and asked again.
#include <algorithm>
#include <iterator>
#include <limits>
#include <memory>
#include <string>
#include <utility>
#include <vector>

#include <fcl/math/bv/OBBRSS.h>
#include <fcl_kios/model.h>

#include "contest.h"
#include "crowd.h"
#include "library.h"
#include "scenario.h"
#include "scenes/robots.h"
#include "scenes/shapes.h"
#include "scenes/unlike.h"

namespace kios::bench {
namespace {

/// Questions of a repeat: all is made and asked, and asked again.
constexpr const char* kQueries[] = {"/cold", "/again"};

double trueDistance(const scenes::BodyScene& scene) {
  const auto& poses = scene.frames[0];
  std::vector<std::pair<double, std::pair<int, int>>> bounds;
  std::vector<double> radii;
  for (const scenes::Mesh& mesh : scene.meshes) {
    double radius = 0;
    for (const fcl::Vector3d& p : mesh.vertices) radius = std::max(radius, p.norm());
    radii.push_back(radius);
  }
  for (int a = 0; a < scene.size(); ++a) {
    for (int b = a + 1; b < scene.size(); ++b) {
      const double apart = (poses[a].translation() - poses[b].translation()).norm();
      bounds.push_back({apart - radii[a] - radii[b], {a, b}});
    }
  }
  std::sort(bounds.begin(), bounds.end());
  double least = std::numeric_limits<double>::infinity();
  for (const auto& [bound, pair] : bounds) {
    if (bound > least) break;
    const auto& [a, b] = pair;
    const scenes::MeshOracle oracle(scene.meshes[a], scene.meshes[b]);
    least = std::min(least, oracle.distance(poses[a], poses[b]));
  }
  return least;
}

/// Wrong verdicts among some of the pairs.
std::size_t wrongOf(const std::vector<BodyPair>& pairs, const scenes::BodyScene& scene,
                    int judged) {
  const std::size_t count =
      judged == 0 ? pairs.size() : std::min(pairs.size(), static_cast<std::size_t>(judged));
  std::size_t wrong = 0;
  for (std::size_t i = 0; i < count; ++i) {
    const auto& [a, b, hit] = pairs[i * pairs.size() / count];
    const scenes::MeshOracle oracle(scene.meshes[a], scene.meshes[b]);
    if (oracle.collide(scene.frames[0][a], scene.frames[0][b]) != hit) ++wrong;
  }
  return wrong;
}

struct Entrant {
  std::string name;
  std::unique_ptr<Crowd> crowd;
  std::vector<BodyPair> pairs = {};
  double distance = 0;
};

std::vector<Entrant> entrantsOf(const Options& options) {
  std::vector<Entrant> entrants;
  for (const std::string& bv : options.bvs) {
    if (isOurs(bv)) entrants.push_back({bv, libraryOf(bv).crowd()});
    if (bv == "fcl_obbrss") {
      entrants.push_back({bv, std::make_unique<CrowdOf<fcl::OBBRSSd, FclCalls>>()});
    }
  }
  return entrants;
}

/// Returns the times of one query of each repeat.
Competitor part(const Competitor& of, std::size_t query) {
  Competitor one{of.name, {}};
  for (const std::vector<double>& us : of.us) one.us.push_back({us[query]});
  return one;
}

/// Rows of making models, as nobody has, and a manager with the first query, `/cold`, and of the
/// next query, `/again`.
void reportCrowd(const std::string& scenario, const scenes::BodyScene& scene, Query query,
                 const Options& options, Report& report) {
  std::vector<Entrant> entrants = entrantsOf(options);
  std::vector<scenes::Mesh> meshes = scene.meshes;
  std::vector<Competitor> competitors;
  for (Entrant& entrant : entrants) {
    const auto answer = [&, query](std::size_t number, std::size_t) {
      if (number == 0) entrant.crowd->make(meshes, scene.frames[0]);
      if (query == Query::kCollide) {
        entrant.crowd->collide(entrant.pairs);
      } else {
        entrant.distance = entrant.crowd->distance();
      }
    };
    const auto before = [&](std::size_t, std::size_t) {
      std::transform(scene.meshes.begin(), scene.meshes.end(), meshes.begin(), scenes::unlike);
    };
    competitors.push_back({entrant.name, answer, before});
  }
  Race{std::size(kQueries), options.repeats, Race::kAll, 1}.run(competitors);

  Row base = baseRow(scenario, name(query), 1, scene.meshes);
  const double truth = query == Query::kDistance ? trueDistance(scene) : 0;
  std::vector<Row> rows;
  for (std::size_t number = 0; number < std::size(kQueries); ++number) {
    std::vector<Competitor> parts;
    for (const Competitor& all : competitors) parts.push_back(part(all, number));
    base.scenario = scenario + kQueries[number];
    for (std::size_t i = 0; i < entrants.size(); ++i) {
      Row row = base.of(parts[i], named("fcl_obbrss", parts));
      if (query == Query::kCollide) {
        row.errors.wrong = wrongOf(entrants[i].pairs, scene, options.oracle_frames);
        row.pairs.total = entrants[i].pairs.size();
      } else {
        row.asked.rel_err = row.asked.abs_err = 0;
        row.errors.max_abs = std::abs(entrants[i].distance - truth);
        row.errors.wrong = (entrants[i].distance == 0) == (truth == 0) ? 0 : 1;
      }
      rows.push_back(std::move(row));
    }
  }
  report.add(rows);
}

}  // namespace

void reportCrowds(const Options& options, Report& report) {
  constexpr double kTouching = 0.28, kApart = 0.6;  // spacing
  const int count = options.quick ? 200 : 2000;
  Options ours = options;
  if (options.bvs == defaultVolumeNames()) ours.bvs = {kOurs, "fcl_obbrss"};
  for (const int triangles : {100, 900}) {
    const std::string size = std::to_string(triangles);
    reportCrowd("crowds/" + size, scenes::packedCrowd(count, triangles, kTouching, options.seed),
                Query::kCollide, ours, report);
    reportCrowd("crowds/" + size, scenes::packedCrowd(count, triangles, kApart, options.seed),
                Query::kDistance, ours, report);
  }
}

}  // namespace kios::bench
