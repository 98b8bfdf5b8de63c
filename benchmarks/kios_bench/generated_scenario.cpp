// SPDX-FileCopyrightText: 2026 The fcl_kios authors
// SPDX-License-Identifier: BSD-3-Clause

#include "motion_report.h"
#include "scenario.h"
#include "scenes/shapes.h"

namespace kios::bench {

void runGenerated(const Options& options, Report& report) {
  constexpr int kFrames = 1200;
  reportMotion("generated/falling", scenes::bentTorus(), scenes::knobbyTorus(),
               scenes::fallingMotion(kFrames), options, report);
  reportMotion("generated/spinning", scenes::bumpyBlob(), scenes::bentTorus(),
               scenes::spinningMotion(kFrames), options, report);
}

}  // namespace kios::bench
