// SPDX-FileCopyrightText: 2026 The fcl_kios authors
// SPDX-License-Identifier: BSD-3-Clause

#pragma once

#include <string>

#include "options.h"
#include "report.h"
#include "scenes/arms.h"

namespace kios::bench {

/// Two arms of one kind, which share the models of their links.
struct TwoArms {
  scenes::Arm arm;
  fcl::Transform3d X_W1;
  fcl::Transform3d X_W2;
};

/// Reports distance, collide and build rows of two moving arms. Each frame asks every pair of a
/// link of the first and a link of the second, none skipped: times and tests of the rows are sums
/// over the pairs of a frame, `total_pairs` counts the queries of all frames. `frames` is the
/// number of frames if the options name none.
void reportArms(const std::string& scenario, const TwoArms& arms, int frames,
                const Options& options, Report& report);

}  // namespace kios::bench
