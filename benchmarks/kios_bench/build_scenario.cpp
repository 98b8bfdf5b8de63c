// SPDX-FileCopyrightText: 2026 The fcl_kios authors
// SPDX-License-Identifier: BSD-3-Clause
//
// From vertices to a finished model: time and memory. Refits, and queries after them.
#include <algorithm>
#include <cmath>
#include <memory>
#include <string>
#include <utility>
#include <vector>

#include <fcl/fcl.h>

#include "allocations.h"
#include "contest.h"
#include "fcl_kios/model/prepare.h"
#include "pose_finder.h"
#include "scenario.h"
#include "scenes/motions.h"
#include "scenes/shapes.h"
#include "scenes/unlike.h"
#include "scenes/ur5_data.h"

namespace kios::bench {
namespace {

using Meshes = std::vector<scenes::Mesh>;

constexpr char kReference[] = "fcl_obbrss";

/// Says what is timed. kBuild: endModel(). kPrepared: and kios::prepare(). kAgain: as kPrepared,
/// while equal models live.
enum class Stage { kBuild, kPrepared, kAgain };

const char* nameOf(Stage stage) {
  constexpr const char* kNames[] = {"build", "prepared", "again"};
  return kNames[static_cast<int>(stage)];
}

/// Takes models over a volume through a stage.
class Builder {
 public:
  virtual ~Builder() = default;

  /// Makes models of these meshes up to endModel(), and drops those before.
  virtual void begin(const Meshes& meshes) = 0;
  virtual void run(Stage stage) = 0;
};

template <typename BV>
class BuilderOf final : public Builder {
 public:
  void begin(const Meshes& meshes) override {
    models_.clear();
    for (const scenes::Mesh& mesh : meshes) {
      auto& model = models_.emplace_back(std::make_shared<fcl::BVHModel<BV>>());
      model->beginModel(static_cast<int>(mesh.triangles.size()),
                        static_cast<int>(mesh.vertices.size()));
      model->addSubModel(mesh.vertices, mesh.triangles);
    }
  }

  void run(Stage stage) override {
    for (const auto& model : models_) {
      model->endModel();
      if constexpr (std::is_same_v<BV, kIOSd>) {
        if (stage != Stage::kBuild) prepare(*model);
      }
    }
  }

 private:
  std::vector<std::shared_ptr<fcl::BVHModel<BV>>> models_;
};

struct Volume {
  const char* name;
  std::unique_ptr<Builder> (*make)();
};

template <typename BV>
std::unique_ptr<Builder> make() {
  return std::make_unique<BuilderOf<BV>>();
}

constexpr Volume kVolumes[] = {{"kios", make<kIOSd>},
                               {kReference, make<fcl::OBBRSSd>},
                               {"fcl_kios_builtin", make<fcl::kIOSd>},
                               {"fcl_aabb", make<fcl::AABBd>},
                               {"fcl_kdop24", make<fcl::KDOPd<24>>}};

/// Returns meshes whose models share nothing with those before.
Meshes unlike(const Meshes& meshes) {
  Meshes others;
  for (const scenes::Mesh& mesh : meshes) others.push_back(scenes::unlike(mesh));
  return others;
}

/// Holds a volume at a stage.
struct Entrant {
  std::string bv;
  Stage stage;
  std::unique_ptr<Builder> builder, equal;  ///< `equal` lives at kAgain

  /// Up to what is timed, with meshes like no others that live.
  void begin(const Meshes& meshes) const {
    builder->begin({});  // what the last run made goes
    if (equal) {
      equal->begin(meshes);
      equal->run(stage);
    }
    builder->begin(meshes);
  }
};

std::vector<Entrant> entrants(const Options& options) {
  std::vector<Entrant> all;
  for (const Volume& volume : kVolumes) {
    const bool ours = volume.make == kVolumes[0].make;
    if (options.quick && !ours && std::string(volume.name) != kReference) continue;
    for (const Stage stage : {Stage::kBuild, Stage::kPrepared, Stage::kAgain}) {
      if (stage != Stage::kBuild && !ours) continue;  // it would be kBuild
      all.push_back(
          {volume.name, stage, volume.make(), stage == Stage::kAgain ? volume.make() : nullptr});
    }
  }
  return all;
}

/// Returns bytes of a run, with those of the arrays that it begins with.
Volumes memoryOf(const Entrant& entrant, const Meshes& meshes, double triangles) {
  Volumes volumes;
  const Meshes fresh = unlike(meshes);
  entrant.begin(fresh);
  entrant.builder->begin({});
  Allocations allocations;
  entrant.builder->begin(fresh);
  allocations.resetPeak();
  entrant.builder->run(entrant.stage);
  if (allocations.peak() == 0) return volumes;
  volumes.bytes_per_triangle = static_cast<double>(allocations.held()) / triangles;
  volumes.peak_bytes_per_triangle = static_cast<double>(allocations.peak()) / triangles;
  return volumes;
}

void race(const std::string& scenario, const Meshes& meshes, const Options& options,
          Report& report) {
  const std::vector<Entrant> all = entrants(options);
  std::vector<Competitor> competitors;
  for (const Entrant& entrant : all) {
    competitors.push_back({entrant.bv + " " + nameOf(entrant.stage),
                           [&](std::size_t, std::size_t) { entrant.builder->run(entrant.stage); },
                           [&](std::size_t, std::size_t) { entrant.begin(unlike(meshes)); }});
  }
  Race{1, options.repeats}.run(competitors);
  Row base;
  base.scenario = scenario;
  base.frames = 1;
  base.seed = options.seed;
  for (const scenes::Mesh& mesh : meshes) {
    base.triangles += mesh.triangles.size();
    base.largest_mesh = std::max(base.largest_mesh, mesh.triangles.size());
    base.extent = std::max(base.extent, scenes::extent(mesh));
  }
  const auto triangles = static_cast<double>(base.triangles);
  const Competitor* const reference =
      named(std::string(kReference) + " " + nameOf(Stage::kBuild), competitors);
  std::vector<Row> rows;
  for (std::size_t i = 0; i < all.size(); ++i) {
    Row& row = rows.emplace_back(base.of(competitors[i], reference));
    row.bv = all[i].bv;
    row.query = nameOf(all[i].stage);
    row.volumes = memoryOf(all[i], meshes, triangles);
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
  PoseFinder distance(after);
  const auto at = [&](const auto& frame) { return distance(frame); };
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
  for (const int size : {1000, 20000, 80000, 320000, 1000000}) {
    if (size > (options.quick ? 1000 : options.max_triangles)) break;
    const scenes::Mesh torus = scenes::bumpyTorus(size);
    race("build/welded/" + std::to_string(size), {torus}, options, report);
    if (size == 80000 || options.quick) {
      race("build/soup/" + std::to_string(size), {scenes::soup(torus)}, options, report);
    }
  }
  const auto data = findData(options);
  if (options.quick || !data || !scenes::holdsUr5(*data)) return;
  Meshes links;
  for (const scenes::Link& link : scenes::loadUr5(*data).links) links.push_back(link.mesh);
  race("build/ur5", links, options, report);
}

}  // namespace kios::bench
