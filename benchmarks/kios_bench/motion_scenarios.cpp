// SPDX-FileCopyrightText: 2026 The fcl_kios authors
// SPDX-License-Identifier: BSD-3-Clause
//
// Two meshes along a motion.
#include <filesystem>

#include "contest.h"
#include "scenario.h"
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

void runFallingShuffled(const Options& options, Report& report) {
  reportShuffled("falling_shuffled", falling(options), options, report);
}

void runSpinning(const Options& options, Report& report) {
  reportMotion("spinning", spinning(options), options, report);
  reportShuffled("spinning_shuffled", spinning(options), options, report);
}

void runSpinningShuffled(const Options& options, Report& report) {
  reportShuffled("spinning_shuffled", spinning(options), options, report);
}

void runGenerated(const Options& options, Report& report) {
  reportMotion("generated/falling", generatedFalling(), options, report);
  reportMotion("generated/spinning", generatedSpinning(), options, report);
}

void runSoup(const Options& options, Report& report) {
  constexpr double kLeast = 1e-6;
  constexpr double kMost = 1e-3;
  scenes::MovingPair pair = generatedFalling();
  pair.a = scenes::shrunkSoup(pair.a, kLeast, kMost, options.seed);
  pair.b = scenes::shrunkSoup(pair.b, kLeast, kMost, options.seed + 1);
  reportMotion("soup", pair, options, report);
}

}  // namespace kios::bench
