// SPDX-FileCopyrightText: 2026 The fcl_kios authors
// SPDX-License-Identifier: BSD-3-Clause
//
// Two meshes along a motion.
#include <algorithm>
#include <cmath>
#include <filesystem>

#include "contest.h"
#include "scenario.h"
#include "scenes/motions.h"
#include "scenes/pqp_data.h"
#include "scenes/shapes.h"

namespace kios::bench {
namespace {

constexpr int kSpinningFrames = 5000;

/// Reports distance, collide and build rows of two meshes along the chosen frames of a motion.
void reportMotion(const std::string& scenario, const scenes::MovingPair& pair,
                  const Options& options, Report& report) {
  const std::vector<scenes::Frame> chosen = chosenFrames(pair.frames, options);
  Contest contest({pair.a, pair.b}, options);
  std::vector<Row> rows;
  for (const Query query : {Query::kDistance, Query::kCollide}) {
    append(contest.queryRows(pairTask(scenario, query, chosen)), rows);
  }
  append(contest.buildRows(scenario), rows);
  report.add(rows);
}

/// Reports distance rows of the same frames in a random order, so that no query profits from the
/// one before.
void reportShuffled(const std::string& scenario, const scenes::MovingPair& pair,
                    const Options& options, Report& report) {
  const auto chosen = scenes::shuffled(chosenFrames(pair.frames, options), options.seed);
  Contest contest({pair.a, pair.b}, options);
  report.add(contest.queryRows(pairTask(scenario, Query::kDistance, chosen)));
}

std::filesystem::path dataFolder(const Options& options) {
  if (const auto found = findData(options)) return *found;
  throw Skipped("the PQP data is absent: name its folder by --data or KIOS_DATA");
}

scenes::MovingPair falling(const Options& options) {
  return scenes::loadFalling(dataFolder(options));
}

scenes::MovingPair spinning(const Options& options) {
  return scenes::loadSpinning(dataFolder(options), kSpinningFrames);
}

}  // namespace

void runFalling(const Options& options, Report& report) {
  reportMotion("falling", falling(options), options, report);
  reportShuffled("falling_shuffled", falling(options), options, report);
}

void runSpinning(const Options& options, Report& report) {
  reportMotion("spinning", spinning(options), options, report);
  reportShuffled("spinning_shuffled", spinning(options), options, report);
}

void runGenerated(const Options& options, Report& report) {
  reportMotion("generated/falling", generatedFalling(), options, report);
  reportMotion("generated/spinning", generatedSpinning(), options, report);
  // Beside each other: what a pair costs that the roots decide.
  scenes::MovingPair pair = generatedFalling();
  double radii = 0;
  for (const scenes::Mesh* mesh : {&pair.a, &pair.b}) {
    double squared = 0;
    for (const fcl::Vector3d& p : mesh->vertices) squared = std::max(squared, p.squaredNorm());
    radii += std::sqrt(squared);
  }
  pair.frames = scenes::farMotion(4000, 1.2 * radii, 1.5 * radii, options.seed);
  Contest contest({pair.a, pair.b}, options);
  report.add(contest.queryRows(
      pairTask("generated/beside", Query::kCollide, chosenFrames(pair.frames, options))));
}

}  // namespace kios::bench
