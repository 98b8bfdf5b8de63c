// SPDX-FileCopyrightText: 2026 The fcl_kios authors
// SPDX-License-Identifier: BSD-3-Clause
// The header of 0.2, which stays until 1.0.
#pragma once

#include "fcl_kios/solid/solids.h"  // IWYU pragma: export
