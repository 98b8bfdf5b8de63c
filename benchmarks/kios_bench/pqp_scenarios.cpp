// SPDX-FileCopyrightText: 2026 The fcl_kios authors
// SPDX-License-Identifier: BSD-3-Clause

#include <filesystem>

#include "motion_report.h"
#include "scenario.h"
#include "scenes/pqp_data.h"

namespace kios::bench {
namespace {

constexpr int kSpinningFrames = 5000;

std::filesystem::path dataFolder(const Options& options) {
  if (const auto found = findData(options)) return *found;
  throw Skipped("the PQP data is absent: name its folder by --data or KIOS_DATA");
}

}  // namespace

void runFalling(const Options& options, Report& report) {
  const scenes::MovingPair pair = scenes::loadFalling(dataFolder(options));
  reportMotion("falling", pair.a, pair.b, pair.frames, options, report);
  reportShuffled("falling_shuffled", pair.a, pair.b, pair.frames, options, report);
}

void runFallingShuffled(const Options& options, Report& report) {
  const scenes::MovingPair pair = scenes::loadFalling(dataFolder(options));
  reportShuffled("falling_shuffled", pair.a, pair.b, pair.frames, options, report);
}

void runSpinning(const Options& options, Report& report) {
  const scenes::MovingPair pair = scenes::loadSpinning(dataFolder(options), kSpinningFrames);
  reportMotion("spinning", pair.a, pair.b, pair.frames, options, report);
  reportShuffled("spinning_shuffled", pair.a, pair.b, pair.frames, options, report);
}

void runSpinningShuffled(const Options& options, Report& report) {
  const scenes::MovingPair pair = scenes::loadSpinning(dataFolder(options), kSpinningFrames);
  reportShuffled("spinning_shuffled", pair.a, pair.b, pair.frames, options, report);
}

}  // namespace kios::bench
