// SPDX-FileCopyrightText: 2026 The fcl_kios authors
// SPDX-License-Identifier: BSD-3-Clause

// All that this file includes outside of simd/ is included before the first target's pass, so that
// no inline function is compiled for an instruction set that a machine may lack.
#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <cstdlib>
#include <cstring>
#include <initializer_list>
#include <limits>
#include <stdexcept>
#include <string>
#include <vector>

#include "engine/search.h"

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "engine/kernels.cpp"
#define HWY_DISABLED_TARGETS HWY_SSSE3
#define HWY_COMPILE_ALL_ATTAINABLE  // the scalar one too
#include <hwy/foreach_target.h>     // NOLINT(llvm-include-order)
#include <hwy/highway.h>            // NOLINT(llvm-include-order)

// In this order.
#include "engine/simd/node_test-inl.h"
//
#include "engine/simd/traverse-inl.h"
//
#include "engine/simd/leaf_cull-inl.h"
//
#include "engine/simd/leaf_pair-inl.h"
//
#include "engine/simd/leaf_distance-inl.h"

HWY_BEFORE_NAMESPACE();
namespace kios::engine::HWY_NAMESPACE {

void distance(const Search& search) {
  traverse(search, [&](const Leaf& a, const Leaf& b, float bound) {
    return nearestOfLeaves(search, a, b, bound);
  });
}

void contact(const Search& search) {
  traverse(search,
           [&](const Leaf& a, const Leaf& b, float) { return contactOfLeaves(search, a, b); });
}

void contacts(const Search& search) {
  traverse(search,
           [&](const Leaf& a, const Leaf& b, float) { return contactsOfLeaves(search, a, b); });
}

extern const Kernels kKernels;
const Kernels kKernels = {HWY_STR(HWY_NAMESPACE) + 2, &distance, &contact, &contacts};  // after N_

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
#if HWY_TARGETS & HWY_NEON
    {HWY_NEON, N_NEON::kKernels},
#endif
#if HWY_TARGETS & HWY_EMU128
    {HWY_EMU128, N_EMU128::kKernels},
#endif
};

const Kernels& choose() {
  const int64_t supported = hwy::SupportedTargets() | HWY_EMU128;
  const char* const wanted = std::getenv("FCL_KIOS_SIMD");
  std::string available;
  for (const Target& target : kTargets) {
    if ((target.bit & supported) == 0) continue;
    if (!wanted || *wanted == '\0' || std::strcmp(wanted, target.kernels.target) == 0) {
      return target.kernels;
    }
    available += std::string(" ") + target.kernels.target;
  }
  throw std::invalid_argument("fcl_kios: FCL_KIOS_SIMD=" + std::string(wanted) +
                              " is not available on this machine; these are:" + available + ".");
}

}  // namespace

const Kernels& kernels() {
  static const Kernels& chosen = choose();
  return chosen;
}

}  // namespace kios::engine
#endif  // HWY_ONCE
