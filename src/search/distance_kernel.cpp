// SPDX-FileCopyrightText: 2026 The fcl_kios authors
// SPDX-License-Identifier: BSD-3-Clause

#include <boost/container/small_vector.hpp>

#include "search/root_body.h"
#include "search/search.h"
#include "search/tuning.h"
#include "tree/compress_table.h"
#include "volume/simd_targets.h"  // with what else is included before the first target's pass

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "search/distance_kernel.cpp"
#define HWY_COMPILE_ALL_ATTAINABLE  // the scalar one too
#include <hwy/cache_control.h>      // NOLINT(llvm-include-order)
#include <hwy/foreach_target.h>     // NOLINT(llvm-include-order)
#include <hwy/highway.h>            // NOLINT(llvm-include-order)

#include "search/simd/pair_search-inl.h"
//
#include "search/simd/wave_search-inl.h"

HWY_BEFORE_NAMESPACE();
namespace kios::engine::HWY_NAMESPACE {

void distance(const Search& search) { WaveSearch<false>(search).run(); }

void bracket(const Search& search) { WaveSearch<true>(search).run(); }

}  // namespace kios::engine::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();
