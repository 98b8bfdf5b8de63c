// SPDX-FileCopyrightText: 2026 The fcl_kios authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstring>

#if defined(__SSE2__)
#include <emmintrin.h>
#endif

#include "volume/rounding.h"

namespace kios::lanes {

/// Four floats, or two doubles, one operation each: every target that g++ and clang++ know, no
/// compiler flags.
using Float4 = float __attribute__((vector_size(16)));
using Double2 = double __attribute__((vector_size(16)));
using Int4 = int __attribute__((vector_size(16)));

inline Float4 broadcast(float v) { return Float4{v, v, v, v}; }

/// Returns a coordinate or length as a float. Those beyond what floats hold square to infinity on
/// both sides of a comparison with a reach, which is near.
inline float toFloat(double x) { return roundedTo<float>(std::clamp(x, -3e38, 3e38)); }

inline Float4 load(const float* p) {
  Float4 v;
  std::memcpy(&v, p, sizeof(v));
  return v;
}

inline void store(float* p, Float4 v) { std::memcpy(p, &v, sizeof(v)); }

inline Double2 load(const double* p) {
  Double2 v;
  std::memcpy(&v, p, sizeof(v));
  return v;
}

inline void store(double* p, Double2 v) { std::memcpy(p, &v, sizeof(v)); }

inline Float4 select(Int4 mask, Float4 a, Float4 b) {
  return reinterpret_cast<Float4>((mask & reinterpret_cast<Int4>(a)) |
                                  (~mask & reinterpret_cast<Int4>(b)));
}

/// The lanes that a mask sets, the first in bit 0.
inline unsigned int bits(Int4 mask) {
#if defined(__SSE2__)
  return static_cast<unsigned int>(_mm_movemask_ps(reinterpret_cast<__m128>(mask)));
#else
  return (mask[0] & 1U) | (mask[1] & 2U) | (mask[2] & 4U) | (mask[3] & 8U);
#endif
}

/// True if any lane of a mask is set.
inline bool any(Int4 mask) { return bits(mask) != 0; }

/// Calls visit(lane) for each of the first `count` lanes, of four at most, that the mask doesn't
/// set, until it returns true, which is returned.
template <typename Visit>
bool visitUnset(Int4 mask, std::size_t count, const Visit& visit) {
  unsigned int left = ~bits(mask) & (count < 4 ? (1U << count) - 1 : 15U);
  for (; left != 0; left &= left - 1) {
    if (visit(static_cast<std::size_t>(__builtin_ctz(left)))) return true;
  }
  return false;
}

/// Lane-wise maximum; b where a is NaN. One instruction.
inline Float4 max(Float4 a, Float4 b) { return a > b ? a : b; }
inline Double2 max(Double2 a, Double2 b) { return a > b ? a : b; }

/// Lane-wise minimum; b where a is NaN. One instruction.
inline Float4 min(Float4 a, Float4 b) { return a < b ? a : b; }
inline Double2 min(Double2 a, Double2 b) { return a < b ? a : b; }

inline Float4 sqrt(Float4 v) {
#if defined(__SSE2__)
  return _mm_sqrt_ps(v);
#else
  return Float4{std::sqrt(v[0]), std::sqrt(v[1]), std::sqrt(v[2]), std::sqrt(v[3])};
#endif
}

inline Double2 sqrt(Double2 v) {
#if defined(__SSE2__)
  return _mm_sqrt_pd(v);
#else
  return Double2{std::sqrt(v[0]), std::sqrt(v[1])};
#endif
}

inline Float4 abs(Float4 v) {
  return reinterpret_cast<Float4>(reinterpret_cast<Int4>(v) & 0x7fffffff);
}

inline Double2 abs(Double2 v) {
#if defined(__SSE2__)
  return _mm_andnot_pd(_mm_set1_pd(-0.0), v);
#else
  return Double2{std::abs(v[0]), std::abs(v[1])};
#endif
}

/// True if a < b and c < d in both lanes.
inline bool bothLess(Double2 a, Double2 b, Double2 c, Double2 d) {
#if defined(__SSE2__)
  return _mm_movemask_pd(_mm_and_pd(_mm_cmplt_pd(a, b), _mm_cmplt_pd(c, d))) == 3;
#else
  return a[0] < b[0] && a[1] < b[1] && c[0] < d[0] && c[1] < d[1];
#endif
}

inline float horizontalMax(Float4 v) {
  const float a = v[0] > v[1] ? v[0] : v[1];
  const float b = v[2] > v[3] ? v[2] : v[3];
  return a > b ? a : b;
}

inline float horizontalMin(Float4 v) { return -horizontalMax(-v); }

}  // namespace kios::lanes
