// SPDX-FileCopyrightText: 2026 The fcl_kios authors
// SPDX-License-Identifier: BSD-3-Clause

#include <cstdio>
#include <utility>

#include "arm_report.h"
#include "scenario.h"
#include "scenes/pqp_data.h"
#include "scenes/ur5_data.h"

namespace kios::bench {
namespace {

TwoArms sideBySide(scenes::Arm arm, double apart) {
  TwoArms arms{std::move(arm), fcl::Transform3d::Identity(), fcl::Transform3d::Identity()};
  arms.X_W2.translation().y() = apart;
  return arms;
}

}  // namespace

void runRobots(const Options& options, Report& report) {
  constexpr double kApart = 0.7;  // about a reach, so that the arms share half their room
  reportArms("robots/generated", sideBySide(scenes::cadArm(), kApart), options, report);
  const auto data = findData(options);
  if (data && scenes::holdsUr5(*data)) {
    reportArms("robots/ur5", sideBySide(scenes::loadUr5(*data), kApart), options, report);
  } else {
    std::printf("robots/ur5 is left out: name the folder of its data by --data or KIOS_DATA\n");
  }
}

}  // namespace kios::bench
