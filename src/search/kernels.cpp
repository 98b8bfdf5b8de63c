// SPDX-FileCopyrightText: 2026 The fcl_kios authors
// SPDX-License-Identifier: BSD-3-Clause

#include <boost/container/small_vector.hpp>

#include "search/cell_search.h"
#include "search/point_search.h"
#include "search/ray_search.h"
#include "search/root_body.h"
#include "search/search.h"
#include "search/solid_search.h"
#include "search/tuning.h"
#include "tree/compress_table.h"
#include "volume/simd_targets.h"  // with what else is included before the first target's pass

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "search/kernels.cpp"
#define HWY_COMPILE_ALL_ATTAINABLE  // the scalar one too
#include <hwy/cache_control.h>      // NOLINT(llvm-include-order)
#include <hwy/foreach_target.h>     // NOLINT(llvm-include-order)
#include <hwy/highway.h>            // NOLINT(llvm-include-order)

#include "search/simd/pair_search-inl.h"
//
#include "search/simd/contact-inl.h"
//
#include "search/simd/ray-inl.h"
//
#include "search/simd/solid_bounds-inl.h"
//
#include "search/simd/solid-inl.h"
//
#include "search/simd/cells-inl.h"
//
#include "search/simd/point-inl.h"
#include "volume/errors.h"

HWY_BEFORE_NAMESPACE();
namespace kios::engine::HWY_NAMESPACE {

// distance_kernel.cpp
void distance(const Search& search);
void bracket(const Search& search);

extern const Kernels kKernels;
const Kernels kKernels = {&HWY_STR(HWY_NAMESPACE)[2],  // after N_
                          &distance,
                          &bracket,
                          &contact,
                          &contacts,
                          &ray,
                          &cells,
                          &solid,
                          &point};

}  // namespace kios::engine::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace kios::engine {
namespace {

struct Target {
  int64_t bit;
  const Kernels& kernels;
};

// Best first.
const Target kTargets[] = {
#if HWY_TARGETS & HWY_AVX3
    {HWY_AVX3, N_AVX3::kKernels},
#endif
#if HWY_TARGETS & HWY_AVX2
    {HWY_AVX2, N_AVX2::kKernels},
#endif
#if HWY_TARGETS & HWY_SSE4
    {HWY_SSE4, N_SSE4::kKernels},
#endif
#if HWY_ARCH_ARM_A64 && (HWY_TARGETS & HWY_NEON)  // 32-bit ARM's rounds otherwise
    {HWY_NEON, N_NEON::kKernels},
#endif
#if HWY_TARGETS & HWY_EMU128
    {HWY_EMU128, N_EMU128::kKernels},
#endif
#if HWY_TARGETS & HWY_SCALAR
    {HWY_SCALAR, N_SCALAR::kKernels},
#endif
};

int64_t supportedTargets() {
#if HWY_ARCH_ARM_A64  // always has NEON; Highway also asks for AES, which no kernel uses
  const int64_t vectors = HWY_NEON;
#else
  const int64_t vectors = hwy::SupportedTargets();
#endif
  return vectors | HWY_EMU128 | HWY_SCALAR;
}

const Kernels& choose() {
  const int64_t supported = supportedTargets();
  const char* const wanted = std::getenv("FCL_KIOS_SIMD");
  std::string available;
  for (const Target& target : kTargets) {
    if ((target.bit & supported) == 0) continue;
    if (!wanted || *wanted == '\0' || std::strcmp(wanted, target.kernels.target) == 0) {
      return target.kernels;
    }
    available += std::string(" ") + target.kernels.target;
  }
  refuse("FCL_KIOS_SIMD=", wanted, " is not available on this machine; these are:", available, ".");
}

}  // namespace

[[gnu::hot]] const Kernels& kernels() {
  static const Kernels& chosen = choose();
  return chosen;
}

}  // namespace kios::engine
#endif  // HWY_ONCE
