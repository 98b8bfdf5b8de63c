// SPDX-FileCopyrightText: 2026 The fcl_kios authors
// SPDX-License-Identifier: BSD-3-Clause
//
// From vertices to a finished model: time and memory. Refits, and queries after them.
#include <cmath>
#include <functional>
#include <memory>
#include <string>
#include <utility>
#include <vector>

#include <fcl/fcl.h>

#include "allocations.h"
#include "contest.h"
#include "fcl_kios/model.h"
#include "library.h"
#include "scenario.h"
#include "scenes/motions.h"
#include "scenes/shapes.h"
#include "scenes/unlike.h"

namespace kios::bench {
namespace {

using Meshes = std::vector<scenes::Mesh>;

constexpr char kReference[] = "fcl_obbrss";

/// Builds models over a volume: begin() up to endModel(), which end() is, of meshes like no others
/// that live. It drops those before.
struct Builder {
  std::string bv, query;
  std::function<void(const Meshes& meshes)> begin;
  std::function<void()> end;
};

/// If `again`, models of the same meshes live already.
template <typename BV>
Builder builderOf(const char* bv, bool again = false) {
  using Models = std::vector<std::shared_ptr<fcl::BVHModel<BV>>>;
  const auto models = std::make_shared<Models>(), equal = std::make_shared<Models>();
  const auto begin = [models, equal, again](const Meshes& meshes) {
    models->clear();
    equal->clear();
    for (const scenes::Mesh& mesh : meshes) {
      if (again) equal->push_back(scenes::buildModel<BV>(mesh));
      auto& model = models->emplace_back(std::make_shared<fcl::BVHModel<BV>>());
      model->beginModel(static_cast<int>(mesh.triangles.size()),
                        static_cast<int>(mesh.vertices.size()));
      model->addSubModel(mesh.vertices, mesh.triangles);
    }
  };
  const auto end = [models] {
    for (const auto& model : *models) model->endModel();
  };
  return {bv, again ? "again" : "build", begin, end};
}

/// Returns meshes whose models share nothing with those before.
Meshes unlike(const Meshes& meshes) {
  Meshes others;
  for (const scenes::Mesh& mesh : meshes) others.push_back(scenes::unlike(mesh));
  return others;
}

std::vector<Builder> builders(const Options& options) {
  std::vector<Builder> all = {builderOf<kIOSd>(kOurs), builderOf<kIOSd>(kOurs, true),
                              builderOf<fcl::OBBRSSd>(kReference)};
  if (options.quick) return all;
  all.push_back(builderOf<fcl::kIOSd>("fcl_kios_builtin"));
  all.push_back(builderOf<fcl::AABBd>("fcl_aabb"));
  return all;
}

/// Returns bytes of a build, with those of the arrays that it begins with.
Volumes memoryOf(const Builder& builder, const Meshes& meshes, double triangles) {
  Volumes volumes;
  const Meshes fresh = unlike(meshes);
  builder.begin({});
  Allocations allocations;
  builder.begin(fresh);
  allocations.resetPeak();
  builder.end();
  if (allocations.peak() == 0) return volumes;
  volumes.bytes_per_triangle = static_cast<double>(allocations.held()) / triangles;
  volumes.peak_bytes_per_triangle = static_cast<double>(allocations.peak()) / triangles;
  return volumes;
}

void race(const std::string& scenario, const Meshes& meshes, const Options& options,
          Report& report) {
  const std::vector<Builder> all = builders(options);
  std::vector<Competitor> competitors;
  for (const Builder& builder : all) {
    competitors.push_back({builder.bv + " " + builder.query,
                           [&](std::size_t, std::size_t) { builder.end(); },
                           [&](std::size_t, std::size_t) { builder.begin(unlike(meshes)); }});
  }
  Race{1, options.repeats}.run(competitors);
  const Row base = baseRow(scenario, "", 1, meshes);
  const auto triangles = static_cast<double>(base.triangles);
  const Competitor* const reference = named(std::string(kReference) + " build", competitors);
  std::vector<Row> rows;
  for (std::size_t i = 0; i < all.size(); ++i) {
    Row& row = rows.emplace_back(base.of(competitors[i], reference));
    row.bv = all[i].bv;
    row.query = all[i].query;
    if (row.query == "build") row.volumes = memoryOf(all[i], meshes, triangles);
    row.volumes.build_us_per_triangle = row.times.median_us / triangles;
  }
  report.add(rows);
}

struct Way {
  const char* name;
  Refit how;
};

constexpr Way kWays[] = {
    {"rebuild", Refit::kRebuild}, {"top_down", Refit::kTopDown}, {"bottom_up", Refit::kBottomUp}};

constexpr double kSway = 0.1;   // of the torus's extent
constexpr double kApart = 4.5;  // clears both tori at any orientation

scenes::Mesh swayed(scenes::Mesh mesh) {
  const double amplitude = kSway * scenes::extent(mesh) / std::sqrt(3.0);
  for (fcl::Vector3d& p : mesh.vertices) {
    p += amplitude * fcl::Vector3d(std::sin(2 * p[1]), std::cos(3 * p[2]), std::sin(2 * p[0] + 1));
  }
  return mesh;
}

void reportRefits(const Options& options, Report& report) {
  const int frames = options.frames > 0 ? options.frames : (options.quick ? 4 : 8);
  // FCL's OBBRSS takes a second a query after its bottom-up refit of 20k triangles.
  const int size = options.quick ? 1000 : 5000;
  const scenes::Mesh before = scenes::bumpyTorus(size), after = swayed(before);
  const std::string scenario = "refit/" + std::to_string(size);
  Contest contest({after, scenes::unlike(after)}, options);  // they share nothing
  const auto at = obbrssDistance(after);
  const auto near = scenes::gapMotion(frames, 0.05, kApart, options.seed, at);
  const auto touching = scenes::gapMotion(frames, 0, kApart, options.seed + 1, at);
  Question first;
  first.poses = touching[0];  // no bounding volume at the roots decides
  std::vector<Row> rows;
  for (const Way& way : kWays) {
    const std::string name = scenario + "/" + way.name;
    append(contest.refitRows(name, {before, scenes::unlike(before)}, way.how, first), rows);
    append(contest.queryRows(pairTask(name, Query::kDistance, near)), rows);
    append(contest.queryRows(pairTask(name, Query::kCollide, touching)), rows);
  }
  report.add(rows);
}

}  // namespace

void runBuild(const Options& options, Report& report) {
  if (wanted(options, "refit")) reportRefits(options, report);
  if (!options.part.empty() && options.part != "models") return;
  for (const int size : allowed(options, {1000, 20000, 80000, 320000, 1000000})) {
    const scenes::Mesh torus = scenes::bumpyTorus(size);
    race("build/welded/" + std::to_string(size), {torus}, options, report);
    if (size == 80000 || options.quick) {
      race("build/soup/" + std::to_string(size), {scenes::soup(torus)}, options, report);
    }
  }
  const auto ur5 = findUr5(options);
  if (options.quick || !ur5) return;
  Meshes links;
  for (const scenes::Link& link : ur5->links) links.push_back(link.mesh);
  race("build/ur5", links, options, report);
}

}  // namespace kios::bench
