// SPDX-FileCopyrightText: 2026 The fcl_kios authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

// What kernels of any folder include before the first target's pass: no inline function may be
// compiled for an instruction set that a machine may lack.
#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <cstdlib>
#include <cstring>
#include <limits>
#include <memory>
#include <string>
#include <utility>
#include <vector>

using std::isnan;  // Highway 1.0's scalar Min() asks for the global one

// Highway's names of the instruction sets that kernels are compiled for, whatever else its version
// knows; to be included before its headers. SVE is not among them: the size of its vectors is known
// at run time only, so that they can't be members or elements of arrays. Machines with SVE have
// NEON. What AVX-512 gained later serves no kernel.
#ifdef FCL_KIOS_FEW_TARGETS  // what sanitizers see is alike in all; they compile each in minutes
#define HWY_DISABLED_TARGETS (~(HWY_AVX2 | HWY_NEON | HWY_EMU128 | HWY_SCALAR))
#else
#define HWY_DISABLED_TARGETS \
  (~(HWY_AVX3 | HWY_AVX2 | HWY_SSE4 | HWY_NEON | HWY_EMU128 | HWY_SCALAR))
#endif
