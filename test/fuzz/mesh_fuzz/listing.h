// SPDX-FileCopyrightText: 2026 The fcl_kios authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <ostream>

#include "fuzz/mesh_fuzz/fuzz_case.h"

namespace kios::fuzz {

/// The case as a C++ program that makes the call which fails: models A, B, C ..., their poses X[0],
/// X[1] ... of the first frame, X1, X2 ... of later ones, all in hexadecimal.
void list(const Case& c, const Failure& failure, std::ostream& out);

}  // namespace kios::fuzz
