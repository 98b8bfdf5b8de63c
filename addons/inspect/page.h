// SPDX-FileCopyrightText: 2026 The fcl_kios authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <string>
#include <vector>

#include "inspection.h"
#include "pair_query.h"

namespace kios::inspect {

struct PageOptions {
  int level = -1;               ///< shown at first; -1: the deepest of at most 64 volumes
  double limit_megabytes = 20;  ///< of meshes and volumes; the rest is left out
};

/// Makes one self-contained HTML page that shows one or two meshes and the volumes of a level, with
/// the statistics of report.h. It names what it leaves out: a mesh beyond half the limit, and the
/// deepest levels. `pair` may be null; with it, the meshes stand at its poses.
std::string page(const std::vector<Inspection>& inspections, const PairQuery* pair,
                 const PageOptions& options);

}  // namespace kios::inspect
