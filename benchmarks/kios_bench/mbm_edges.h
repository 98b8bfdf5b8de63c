// SPDX-FileCopyrightText: 2026 The fcl_kios authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <string>
#include <vector>

#include "mbm_problems.h"
#include "options.h"
#include "report.h"

namespace kios::bench {

/// What single questions cost among the problems' obstacles, in us, with rows: paths of 0.05, 0.2
/// and 0.8 rad in the largest joint from a free configuration, those that are free and those that
/// aren't, each proven, sampled, and by FCL's manager; configurations at random, in contact or not;
/// the clearance with its gradient.
void measureQuestions(const std::string& name, const Robot& bare,
                      const std::vector<Problem>& problems, const Options& options, Report& report);

}  // namespace kios::bench
