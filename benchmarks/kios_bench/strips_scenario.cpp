// SPDX-FileCopyrightText: 2026 The fcl_kios authors
// SPDX-License-Identifier: BSD-3-Clause

#include "arm_report.h"
#include "scenario.h"

namespace kios::bench {

void runStrips(const Options& options, Report& report) {
  constexpr int kFrames = 40;  // FCL's k-IOS takes 0.3 s for one, its OBBRSS 3 ms
  TwoArms chains{scenes::stripChain(), fcl::Transform3d::Identity(), fcl::Transform3d::Identity()};
  // The second points back at the first, askew: none of their cylinders stay parallel.
  chains.X_W2 =
      fcl::AngleAxisd(3.3, fcl::Vector3d::UnitZ()) * fcl::AngleAxisd(0.5, fcl::Vector3d::UnitX());
  chains.X_W2.translation() = fcl::Vector3d(1.8, 0.4, 0.1);
  reportArms("strips", chains, kFrames, options, report);
}

}  // namespace kios::bench
