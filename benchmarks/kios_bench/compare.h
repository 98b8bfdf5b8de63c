// SPDX-FileCopyrightText: 2026 The fcl_kios authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <vector>

#include "report.h"

namespace kios::bench {

/// Prints a line for each row of real work of ours that has one before beside it: both times, that
/// of before by that of now (the median of the repeats' ratios, that of the minima), OBBRSS's time
/// by each, counts of work, answers that changed.
void printCompared(const std::vector<Row>& rows);

/// Prints the lines of the `shown` least ratios and, of all, the geometric mean. Returns how many
/// rows have both ratios below kLeastRatio, or other answers.
inline constexpr double kLeastRatio = 0.9;
int summarize(const std::vector<Row>& rows, std::size_t shown);

}  // namespace kios::bench
