// SPDX-FileCopyrightText: 2026 The fcl_kios authors
// SPDX-License-Identifier: BSD-3-Clause
//
// From vertices to a finished model: time and memory, for every volume of FCL.
#include <algorithm>
#include <cstdio>
#include <memory>
#include <string>
#include <utility>
#include <vector>

#include <fcl/fcl.h>

#include "allocations.h"
#include "fcl_kios/model/prepare.h"
#include "fcl_kios/model/storage.h"
#include "model/prepared.h"
#include "scenario.h"
#include "scenes/shapes.h"
#include "scenes/unlike.h"
#include "scenes/ur5_data.h"

namespace kios::bench {
namespace {

using Meshes = std::vector<scenes::Mesh>;

constexpr char kReference[] = "fcl_obbrss";

/// Says what is timed. kBuild: endModel(). kPrepared: and kios::prepare(). kAgain: as kPrepared,
/// while equal models live. kLoaded: kios::load() of what kios::save() stored, in place of
/// kPrepared.
enum class Stage { kBuild, kPrepared, kAgain, kLoaded };

const char* nameOf(Stage stage) {
  constexpr const char* kNames[] = {"build", "prepared", "again", "loaded"};
  return kNames[static_cast<int>(stage)];
}

/// Takes models over a volume through a stage.
class Builder {
 public:
  virtual ~Builder() = default;

  /// Makes models of these meshes up to endModel(), and drops those before.
  virtual void begin(const Meshes& meshes) = 0;
  /// Puts stored models in the place of those begun.
  virtual void store(const Meshes& meshes) = 0;
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

  void store(const Meshes& meshes) override {
    models_.clear();
    stored_.clear();
    if constexpr (std::is_same_v<BV, kIOSd>) {
      for (const scenes::Mesh& mesh : meshes) {
        stored_.push_back(save(*makeModel(mesh.vertices, mesh.triangles)));
      }
    }
  }

  void run(Stage stage) override {
    if constexpr (std::is_same_v<BV, kIOSd>) {
      if (stage == Stage::kLoaded) {
        for (const auto& bytes : stored_) {
          models_.push_back(load(bytes.data(), bytes.size()));
          prepare(*models_.back());
        }
        return;
      }
    }
    for (const auto& model : models_) {
      model->endModel();
      if constexpr (std::is_same_v<BV, kIOSd>) {
        if (stage == Stage::kPrepared || stage == Stage::kAgain) prepare(*model);
      }
    }
  }

 private:
  std::vector<std::shared_ptr<fcl::BVHModel<BV>>> models_;
  std::vector<std::vector<unsigned char>> stored_;
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
                               {"fcl_obb", make<fcl::OBBd>},
                               {"fcl_rss", make<fcl::RSSd>},
                               {"fcl_kios_builtin", make<fcl::kIOSd>},
                               {"fcl_aabb", make<fcl::AABBd>},
                               {"fcl_kdop16", make<fcl::KDOPd<16>>},
                               {"fcl_kdop18", make<fcl::KDOPd<18>>},
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
    if (stage == Stage::kLoaded) return builder->store(meshes);
    builder->begin(meshes);
  }
};

std::vector<Entrant> entrants(const Options& options) {
  std::vector<Entrant> all;
  for (const Volume& volume : kVolumes) {
    const bool ours = volume.make == kVolumes[0].make;
    if (options.quick && !ours && std::string(volume.name) != kReference) continue;
    for (const Stage stage : {Stage::kBuild, Stage::kPrepared, Stage::kAgain, Stage::kLoaded}) {
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
  if (entrant.stage == Stage::kLoaded) return volumes;
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

/// Says where the bytes of a prepared model go.
void reportBytes(const std::string& scenario, const scenes::Mesh& mesh, const Options& options,
                 Report& report) {
  const auto model = scenes::buildModel<kIOSd>(mesh);
  const engine::Tree* const tree = &treeOf(*model);
  const auto n = static_cast<double>(mesh.triangles.size());
  const auto bytesOf = [](const auto& array) {
    return static_cast<double>(array.capacity() * sizeof(array[0]));
  };
  const std::pair<const char*, double> parts[] = {
      {"vertices", bytesOf(mesh.vertices)},
      {"triangles", bytesOf(mesh.triangles)},
      {"volumes of FCL's tree", model->getNumBVs() * double{sizeof(model->getBV(0))}},
      {"its order of triangles", n * sizeof(unsigned int)},
      {"nodes of the prepared tree", bytesOf(tree->nodes)},
      {"their boxes", bytesOf(tree->boxes) + bytesOf(tree->box_blocks)},
      {"blocks of children", bytesOf(tree->blocks) + bytesOf(tree->children)},
      {"leaves", bytesOf(tree->leaves)},
      {"their vertices and faces", bytesOf(tree->lanes)},
      {"ids of features", bytesOf(tree->features)},
      {"welded corners", bytesOf(tree->corners)}};
  std::vector<Row> rows;
  for (const auto& [part, bytes] : parts) {
    Row& row = rows.emplace_back();
    row.scenario = scenario;
    row.query = part;
    row.bv = "kios";
    row.triangles = mesh.triangles.size();
    row.seed = options.seed;
    row.volumes.bytes_per_triangle = bytes / n;
    std::printf("%-25s %-27s %6.1f bytes a triangle\n", scenario.c_str(), part, bytes / n);
  }
  std::printf("\n");
  report.addUnprinted(rows);
}

}  // namespace

void runBuild(const Options& options, Report& report) {
  for (const int size : {1000, 5000, 20000, 80000, 320000, 1000000}) {
    if (size > (options.quick ? 1000 : options.max_triangles)) break;
    const scenes::Mesh torus = scenes::bumpyTorus(size);
    race("build/welded/" + std::to_string(size), {torus}, options, report);
    race("build/soup/" + std::to_string(size), {scenes::soup(torus)}, options, report);
  }
  const scenes::Mesh torus = scenes::bumpyTorus(options.quick ? 1000 : 20000);
  reportBytes("build/bytes/welded", torus, options, report);
  reportBytes("build/bytes/soup", scenes::soup(torus), options, report);
  const auto data = findData(options);
  if (options.quick || !data || !scenes::holdsUr5(*data)) return;
  Meshes links;
  for (const scenes::Link& link : scenes::loadUr5(*data).links) links.push_back(link.mesh);
  race("build/ur5", links, options, report);
}

}  // namespace kios::bench
