// SPDX-FileCopyrightText: 2026 The fcl_kios authors
// SPDX-License-Identifier: BSD-3-Clause

#include "arm_report.h"
#include "scenario.h"

namespace kios::bench {

void runStrips(const Options& options, Report& report) {
  constexpr double kApart = 0.5;
  TwoArms arms{scenes::stripChain(), fcl::Transform3d::Identity(), fcl::Transform3d::Identity()};
  arms.X_W2.translation().y() = kApart;
  reportArms("strips", arms, options, report);
}

}  // namespace kios::bench
