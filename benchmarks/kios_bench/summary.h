// SPDX-FileCopyrightText: 2026 The fcl_kios authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "report.h"

namespace kios::bench {

/// Says in a sentence each what rows show: how many times as fast ours is as the fastest volume of
/// FCL, for distances and for first contacts, in the geometric mean and at least; how many rows the
/// oracle judged, and how they fell; memory and time to build beside OBBRSS. Leaves out a sentence
/// that no row tells anything about.
std::vector<std::string> inWords(const std::vector<Row>& rows);

/// Writes an HTML page that shows the sentences, and a bar for each volume of every question.
void writePage(const std::vector<Row>& rows, const std::filesystem::path& file);

}  // namespace kios::bench
