// SPDX-FileCopyrightText: 2026 The fcl_kios authors
// SPDX-License-Identifier: BSD-3-Clause
#include "tree/fingerprint.h"

#include <chrono>
#include <cstring>
#include <exception>
#include <numeric>
#include <random>

#include "volume/simd_targets.h"

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "tree/fingerprint.cpp"
#include <hwy/foreach_target.h>  // NOLINT(llvm-include-order)
#include <hwy/highway.h>         // NOLINT(llvm-include-order)

HWY_BEFORE_NAMESPACE();
namespace kios::engine::HWY_NAMESPACE {

/// Adds to sums[k], for each 64 bits of data, the product of their two halves, each with its half
/// of key k added modulo 2^32; modulo 2^64. Bytes that lack at the end count as zeros.
void addProducts(const uint8_t* HWY_RESTRICT data, size_t bytes, const uint8_t* HWY_RESTRICT key0,
                 const uint8_t* HWY_RESTRICT key1, uint64_t* HWY_RESTRICT sums) {
#if HWY_TARGET == HWY_SCALAR
  for (size_t i = 0; i < bytes; i += 8) {
    uint32_t x[2] = {}, k[2];
    const uint8_t* const keys[2] = {key0, key1};
    std::memcpy(x, data + i, bytes - i < 8 ? bytes - i : 8);
    for (int s = 0; s < 2; ++s) {
      std::memcpy(k, keys[s] + i, 8);
      sums[s] += uint64_t{x[0] + k[0]} * uint64_t{x[1] + k[1]};
    }
  }
#else
  namespace hn = hwy::HWY_NAMESPACE;
  const hn::ScalableTag<uint32_t> half;
  const hn::ScalableTag<uint64_t> whole;
  const size_t width = 4 * hn::Lanes(half);
  const auto product = [&](hn::Vec<decltype(half)> x, const uint8_t* key) {
    const auto sum = hn::Add(x, hn::LoadU(half, reinterpret_cast<const uint32_t*>(key)));
    const auto high = hn::BitCast(half, hn::ShiftRight<32>(hn::BitCast(whole, sum)));
    return hn::MulEven(sum, high);
  };
  auto a0 = hn::Zero(whole), a1 = a0, b0 = a0, b1 = a0;
  size_t i = 0;
  for (; i + 2 * width <= bytes; i += 2 * width) {
    const auto x = hn::LoadU(half, reinterpret_cast<const uint32_t*>(data + i));
    const auto y = hn::LoadU(half, reinterpret_cast<const uint32_t*>(data + i + width));
    a0 = hn::Add(a0, product(x, key0 + i));
    b0 = hn::Add(b0, product(x, key1 + i));
    a1 = hn::Add(a1, product(y, key0 + i + width));
    b1 = hn::Add(b1, product(y, key1 + i + width));
  }
  for (; i < bytes; i += width) {
    HWY_ALIGN uint8_t rest[HWY_MAX_BYTES] = {};  // zeros add what the keys alone give
    std::memcpy(rest, data + i, bytes - i < width ? bytes - i : width);
    const auto x = hn::Load(half, reinterpret_cast<const uint32_t*>(rest));
    a0 = hn::Add(a0, product(x, key0 + i));
    b0 = hn::Add(b0, product(x, key1 + i));
  }
  // Not by SumOfLanes, which compilers of AVX-512 may add up as signed numbers, that must not wrap.
  const auto sum = [&](hn::Vec<decltype(whole)> lanes) {
    HWY_ALIGN uint64_t each[HWY_MAX_BYTES / sizeof(uint64_t)];
    hn::Store(lanes, whole, each);
    return std::accumulate(each, each + hn::Lanes(whole), uint64_t{0});
  };
  sums[0] += sum(hn::Add(a0, a1));
  sums[1] += sum(hn::Add(b0, b1));
#endif
}

}  // namespace kios::engine::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace kios::engine {
namespace {

HWY_EXPORT(addProducts);

__extension__ typedef unsigned __int128 Wide;  // NOLINT(modernize-use-using)

constexpr std::size_t kBlock = 4096;
constexpr std::uint64_t kPrime = (std::uint64_t{1} << 61) - 1;

struct Keys {
  // The last vector of a block may reach beyond it.
  alignas(64) std::uint8_t of_sums[2][kBlock + 256];
  std::uint64_t points[2], squares[2];

  Keys() {
    std::seed_seq::result_type words[8];
    try {
      std::random_device device;
      for (auto& word : words) word = device();
    } catch (const std::exception&) {  // a system without a source of them
      auto now =
          static_cast<std::uint64_t>(std::chrono::steady_clock::now().time_since_epoch().count());
      for (auto& word : words) word = static_cast<std::uint32_t>(now *= 0x9E3779B97F4A7C15U);
    }
    std::seed_seq seeds(std::begin(words), std::end(words));
    std::mt19937_64 draw(seeds);
    for (auto& keys : of_sums) {
      for (std::size_t i = 0; i < sizeof(keys); i += 8) {
        const std::uint64_t word = draw();
        std::memcpy(keys + i, &word, 8);
      }
    }
    for (int k = 0; k < 2; ++k) {
      points[k] = 1 + draw() % (kPrime - 1);
      squares[k] = reduced(Wide{points[k]} * points[k]);
    }
  }

  /// x modulo the prime, for x < 2^123; the prime itself may stand for 0.
  static std::uint64_t reduced(Wide x) {
    const std::uint64_t once =
        (static_cast<std::uint64_t>(x) & kPrime) + static_cast<std::uint64_t>(x >> 61);
    return (once & kPrime) + (once >> 61);
  }
};
const Keys& keys() {
  static const Keys of_process;
  return of_process;
}

}  // namespace

Fingerprint fingerprint(const void* one, std::size_t one_bytes, const void* other,
                        std::size_t other_bytes) {
  const Keys& of = keys();
  std::uint64_t polynomials[2] = {1, 1};
  const struct {
    const void* data;
    std::size_t bytes;
  } arrays[2] = {{one, one_bytes}, {other, other_bytes}};
  for (const auto& array : arrays) {
    const auto* at = static_cast<const std::uint8_t*>(array.data);
    for (std::size_t left = array.bytes; left > 0;) {
      const std::size_t bytes = left < kBlock ? left : kBlock;
      std::uint64_t sums[2] = {0, 0};
      // Anew for each block: what it gives at first chooses at every call, which takes 20 us.
      HWY_DYNAMIC_DISPATCH(addProducts)(at, bytes, of.of_sums[0], of.of_sums[1], sums);
      for (int k = 0; k < 2; ++k) {  // Horner's rule, a step for each half of the sum
        polynomials[k] =
            Keys::reduced(Wide{polynomials[k]} * of.squares[k] +
                          Wide{sums[k] >> 32} * of.points[k] + (sums[k] & 0xFFFFFFFFU));
      }
      at += bytes;
      left -= bytes;
    }
  }
  return {polynomials[0], polynomials[1]};
}

}  // namespace kios::engine
#endif  // HWY_ONCE
