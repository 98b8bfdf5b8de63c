// SPDX-FileCopyrightText: 2026 The fcl_kios authors
// SPDX-License-Identifier: BSD-3-Clause

#pragma once

#include <stdexcept>

#include "options.h"
#include "report.h"

namespace kios::bench {

/// Thrown by a scenario that cannot run here, for instance without its data; says why and what to
/// do.
class Skipped : public std::runtime_error {
 public:
  using std::runtime_error::runtime_error;
};

void runTori(const Options& options, Report& report);
void runRobots(const Options& options, Report& report);
void runWorld(const Options& options, Report& report);
void runScene(const Options& options, Report& report);
void runShapes(const Options& options, Report& report);
void runRays(const Options& options, Report& report);
void runSolids(const Options& options, Report& report);
void runClashes(const Options& options, Report& report);
void runMotions(const Options& options, Report& report);
#ifdef KIOS_HAVE_ROBOT
void runMbm(const Options& options, Report& report);
#endif
void runBuild(const Options& options, Report& report);
void runError(const Options& options, Report& report);
void runPaper(const Options& options, Report& report);
void runStability(const Options& options, Report& report);
#ifdef KIOS_HAVE_PRELOAD
void runPreload(const Options& options, Report& report);
#endif

// Parts of several files.
void reportRobotScenes(const Options& options, Report& report);  // of robots
void reportCrowds(const Options& options, Report& report);       // of scene
void reportPoints(const Options& options, Report& report);       // of solids
void reportStress(const Options& options, Report& report);       // of stability
void reportRanges(const Options& options, Report& report);       // of motions
void reportMoved(const Options& options, Report& report);        // of motions
void reportContinuous(const Options& options, Report& report);   // of motions

}  // namespace kios::bench
