// SPDX-FileCopyrightText: 2026 The fcl_kios authors
// SPDX-License-Identifier: BSD-3-Clause

#include "motion_report.h"
#include "scenario.h"
#include "scenes/shapes.h"

namespace kios::bench {

namespace {

constexpr int kFrames = 1200;

}  // namespace

void runGenerated(const Options& options, Report& report) {
  reportMotion("generated/falling", scenes::bentTorus(), scenes::knobbyTorus(),
               scenes::fallingMotion(kFrames), options, report);
  reportMotion("generated/spinning", scenes::bumpyBlob(), scenes::bentTorus(),
               scenes::spinningMotion(kFrames), options, report);
}

void runSoup(const Options& options, Report& report) {
  constexpr double kLeast = 1e-6;
  constexpr double kMost = 1e-3;
  reportMotion("soup", scenes::shrunkSoup(scenes::bentTorus(), kLeast, kMost, options.seed),
               scenes::shrunkSoup(scenes::knobbyTorus(), kLeast, kMost, options.seed + 1),
               scenes::fallingMotion(kFrames), options, report);
}

}  // namespace kios::bench
