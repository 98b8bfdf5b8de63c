// SPDX-FileCopyrightText: 2026 The fcl_kios authors
// SPDX-License-Identifier: BSD-3-Clause

// All that this file includes is included before the first target's pass, as in search/kernels.cpp.
#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <limits>

#include "paper/packing_tests.h"
#include "volume/lanes.h"
#include "volume/simd_targets.h"

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "paper/packing_tests.cpp"
#include <hwy/foreach_target.h>  // NOLINT(llvm-include-order)
#include <hwy/highway.h>         // NOLINT(llvm-include-order)

#include "search/simd/node_test-inl.h"

HWY_BEFORE_NAMESPACE();
namespace kios::paper::HWY_NAMESPACE {

void testEightNodes(const PackingPairs& pairs, bool /*overlap*/, float* bounds,
                    PackingCounts& counts) {
  namespace simd = kios::engine::HWY_NAMESPACE;
  for (std::size_t g = 0; g < pairs.groups(); ++g) {
    simd::MovedNode b;
    simd::move(pairs.node_b[g], pairs.X_AB[g], 0, b);
    for (std::size_t l = 0; l < engine::kLanes; l += simd::step()) {
      simd::hn::StoreU(simd::lowerBounds(pairs.block_a[g], l, b), simd::d,
                       bounds + engine::kLanes * g + l);
      counts.packed += 9;
    }
  }
}

}  // namespace kios::paper::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace kios::paper {
namespace {

using lanes::Float4;

constexpr float kNone = -std::numeric_limits<float>::infinity();

float signedDistance(const SphereSet& a, int i, const SphereSet& b, int j) {
  const float x = a.x[i] - b.x[j], y = a.y[i] - b.y[j], z = a.z[i] - b.z[j];
  return std::sqrt(x * x + y * y + z * z) - (a.r[i] + b.r[j]);
}

/// b in A's frame.
SphereSet moved(const SphereSet& b, const engine::FloatPose& X) {
  SphereSet out = b;
  for (int j = 0; j < b.k; ++j) {
    out.x[j] = X.R[0][0] * b.x[j] + X.R[0][1] * b.y[j] + X.R[0][2] * b.z[j] + X.t[0];
    out.y[j] = X.R[1][0] * b.x[j] + X.R[1][1] * b.y[j] + X.R[1][2] * b.z[j] + X.t[1];
    out.z[j] = X.R[2][0] * b.x[j] + X.R[2][1] * b.y[j] + X.R[2][2] * b.z[j] + X.t[2];
  }
  return out;
}

/// Holds the sphere pairs (n / k_B, n mod k_B) of two k-IOS, four a row.
struct Packing {
  int rows = 0;
  bool one_left = false;
  std::uint8_t i[7][4] = {}, j[7] = {};  ///< of A by lane; of B the first

  Packing(int k_a, int k_b) {
    const int all = k_a * k_b, left = all % 4;
    one_left = left == 1;
    rows = all / 4 + (left > 1 ? 1 : 0);
    for (int row = 0; row < rows; ++row) {
      for (int lane = 0; lane < 4; ++lane) {  // a lane beyond the last tests some pair again
        i[row][lane] = static_cast<std::uint8_t>(std::min((4 * row + lane) / k_b, k_a - 1));
      }
      j[row] = static_cast<std::uint8_t>(4 * row % k_b);
    }
  }
};

const Packing kPackings[3][3] = {
    {{1, 1}, {1, 3}, {1, 5}}, {{3, 1}, {3, 3}, {3, 5}}, {{5, 1}, {5, 3}, {5, 5}}};

float scalarBound(const SphereSet& a, const SphereSet& b, bool overlap, PackingCounts& counts) {
  float best = kNone;
  for (int i = 0; i < a.k; ++i) {
    for (int j = 0; j < b.k; ++j) {
      ++counts.scalar;
      best = std::max(best, signedDistance(a, i, b, j));
      if (overlap && best > 0) return best;
    }
  }
  return best;
}

float packedBound(const SphereSet& a, const SphereSet& b, bool overlap, PackingCounts& counts) {
  const Packing& packing = kPackings[a.k / 2][b.k / 2];
  Float4 best = lanes::broadcast(kNone);
  for (int row = 0; row < packing.rows; ++row) {
    const std::uint8_t* const i = packing.i[row];
    const auto ofA = [i](const float* v) { return Float4{v[i[0]], v[i[1]], v[i[2]], v[i[3]]}; };
    const int j = packing.j[row];
    const Float4 x = ofA(a.x) - lanes::load(b.x + j), y = ofA(a.y) - lanes::load(b.y + j),
                 z = ofA(a.z) - lanes::load(b.z + j), r = ofA(a.r) + lanes::load(b.r + j);
    ++counts.packed;
    best = lanes::max(best, lanes::sqrt(x * x + y * y + z * z) - r);
    if (overlap && lanes::horizontalMax(best) > 0) return lanes::horizontalMax(best);
  }
  const float packed = lanes::horizontalMax(best);
  if (!packing.one_left) return packed;
  ++counts.scalar;
  return std::max(packed, signedDistance(a, a.k - 1, b, b.k - 1));
}

/// Each node of B is moved once for its eight nodes of A, whatever the test of a pair.
template <typename Bound>
void testPairs(const PackingPairs& pairs, float* bounds, const Bound& bound) {
  for (std::size_t g = 0; g < pairs.groups(); ++g) {
    SphereSet b = moved(pairs.b[g], pairs.X_AB[g]);
    b.repeat();
    for (std::size_t l = 0; l < 8; ++l) bounds[8 * g + l] = bound(pairs.a[g][l], b);
  }
}

}  // namespace

void SphereSet::repeat() {
  for (int i = k; i < 8; ++i) {
    x[i] = x[i - k];
    y[i] = y[i - k];
    z[i] = z[i - k];
    r[i] = r[i - k];
  }
}

void testScalar(const PackingPairs& pairs, bool overlap, float* bounds, PackingCounts& counts) {
  testPairs(pairs, bounds, [&](const SphereSet& a, const SphereSet& b) {
    return scalarBound(a, b, overlap, counts);
  });
}

void testPackedByFour(const PackingPairs& pairs, bool overlap, float* bounds,
                      PackingCounts& counts) {
  testPairs(pairs, bounds, [&](const SphereSet& a, const SphereSet& b) {
    return packedBound(a, b, overlap, counts);
  });
}

std::vector<EightNodesTest> eightNodesTests() {
  const std::int64_t supported = hwy::SupportedTargets();
  std::vector<EightNodesTest> tests;
  const auto add = [&](std::int64_t bit, const char* target, PackingTest test) {
    if ((supported & bit) != 0) tests.push_back({target, test});
  };
#if HWY_TARGETS & HWY_AVX3
  add(HWY_AVX3, "AVX3", N_AVX3::testEightNodes);
#endif
#if HWY_TARGETS & HWY_AVX2
  add(HWY_AVX2, "AVX2", N_AVX2::testEightNodes);
#endif
#if HWY_TARGETS & HWY_SSE4
  add(HWY_SSE4, "SSE4", N_SSE4::testEightNodes);
#endif
#if HWY_TARGETS & HWY_NEON
  add(HWY_NEON, "NEON", N_NEON::testEightNodes);
#endif
  if (tests.empty()) tests.push_back({"static", HWY_STATIC_DISPATCH(testEightNodes)});
  return tests;
}

}  // namespace kios::paper
#endif  // HWY_ONCE
