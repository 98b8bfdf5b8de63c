// SPDX-FileCopyrightText: 2026 The fcl_kios authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <nlohmann/json.hpp>
#include <string>

#include "inspection.h"
#include "pair_query.h"

namespace kios::inspect {

using Json = nlohmann::ordered_json;

/// The report that docs/inspect.md lists: lengths in the file's units, slack in parts of the
/// content's size.
Json toJson(const Inspection& inspection);
Json toJson(const PairQuery& query);

/// Writes the same for people.
std::string toText(const Inspection& inspection);
std::string toText(const PairQuery& query);

}  // namespace kios::inspect
