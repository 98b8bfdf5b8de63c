// SPDX-FileCopyrightText: 2026 The fcl_kios authors
// SPDX-License-Identifier: BSD-3-Clause

#include <cstdio>

#include "arm_report.h"
#include "scenario.h"
#include "scenes/pqp_data.h"
#include "scenes/ur5_data.h"

namespace kios::bench {

void runRobots(const Options& options, Report& report) {
  constexpr int kFrames = 100;  // FCL's OBBRSS takes 17 ms for one
  TwoArms generated{scenes::cadArm(), fcl::Transform3d::Identity(), fcl::Transform3d::Identity()};
  generated.X_W2.linear() = fcl::Vector3d(-1, -1, 1).asDiagonal();  // they face each other
  generated.X_W2.translation().x() = 0.7;
  reportArms("robots/generated", generated, kFrames, options, report);

  const auto data = findData(options);
  if (!data || !scenes::holdsUr5(*data)) {
    std::printf("robots/ur5 is left out: name the folder of its data by --data or KIOS_DATA\n");
    runRobotScenes(options, report);
    return;
  }
  TwoArms ur5{scenes::loadUr5(*data), fcl::Transform3d::Identity(), fcl::Transform3d::Identity()};
  ur5.X_W2.translation().y() = 0.5;
  reportArms("robots/ur5", ur5, kFrames, options, report);
  runRobotScenes(options, report);
}

}  // namespace kios::bench
