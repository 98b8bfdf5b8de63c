// SPDX-FileCopyrightText: 2026 The fcl_kios authors
// SPDX-License-Identifier: BSD-3-Clause

#pragma once

#include <vector>

namespace kios::bench {

/// This thread's CPU time where the system has it, so that other programs disturb it least.
double nowMicroseconds();

double median(std::vector<double> values);

}  // namespace kios::bench
