// SPDX-FileCopyrightText: 2026 The fcl_kios authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "fuzz/mesh_fuzz/fuzz_case.h"

namespace kios::fuzz {

/// Asks the case. What the library throws is a failure too: no case is one that it may refuse.
Verdict ask(const Case& c);

/// Returns the smallest case found within `seconds` that fails as well: fewer triangles, frames and
/// models, simple poses.
Case shrunk(Case c, double seconds);

}  // namespace kios::fuzz
