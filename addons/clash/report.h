// SPDX-FileCopyrightText: 2026 The fcl_kios authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <nlohmann/json.hpp>
#include <string>
#include <vector>

#include "parts.h"

namespace kios::clash_tool {

using Json = nlohmann::ordered_json;

/// What was asked and found; clashes name parts by their places in `assembly`.
struct Report {
  Assembly assembly;
  double touch = 0, clearance = 0;
  std::vector<ClashResult> clashes;

  /// The places of the clashes, the worst first: by status, then depth or distance.
  std::vector<std::size_t> bySeverity() const;
  /// Whether there is more than touches.
  bool clashing() const;
};

const char* nameOf(ClashStatus status);

/// The report as docs/clash.schema.json has it.
Json toJson(const Report& report);
/// A line for each clash under a head.
std::string toCsv(const Report& report);
/// For people: touches are counted alone.
std::string toText(const Report& report);

}  // namespace kios::clash_tool
