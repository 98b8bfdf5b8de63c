// SPDX-FileCopyrightText: 2026 The fcl_kios authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "preload/calls.h"

namespace kios::preload {

/// Returns the count of this process.
const Fits& fits();

/// From now on calls of FCL's fitting functions are counted; before, they are only handed on.
void countFits();

}  // namespace kios::preload
