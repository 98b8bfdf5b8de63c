// SPDX-FileCopyrightText: 2026 The fcl_kios authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "fuzz/mesh_fuzz/fuzz_case.h"

namespace kios::fuzz {

/// Returns the case of a seed and an index. `only`: the question, if it isn't to be drawn.
Case drawCase(std::uint64_t seed, std::uint64_t index, const Question* only);

}  // namespace kios::fuzz
