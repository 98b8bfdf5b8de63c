// SPDX-FileCopyrightText: 2026 The fcl_kios authors
// SPDX-License-Identifier: BSD-3-Clause
#include "fcl_kios/overloads.h"  // as in the tests

#define KIOS_FCL_TABLE template
#include "fcl_tables.h"
