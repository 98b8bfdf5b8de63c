// SPDX-FileCopyrightText: 2026 The fcl_kios authors
// SPDX-License-Identifier: BSD-3-Clause
#include "tree/fingerprint.h"

#include <cstring>
#include <random>
#include <set>
#include <utility>
#include <vector>

#include <gtest/gtest.h>

namespace kios::engine {
namespace {

using Words = std::vector<std::uint64_t>;

Fingerprint of(const Words& one, const Words& other) {
  return fingerprint(one.data(), 8 * one.size(), other.data(), 8 * other.size());
}

Words randomWords(std::size_t n, std::mt19937_64& random) {
  Words words(n);
  for (auto& word : words) word = random();
  return words;
}

// Lengths about those of vectors and blocks.
const std::size_t kLengths[] = {0,   1,   2,   3,   5,   7,   8,   9,    15,   16,   17,  31,
                                33,  63,  64,  65,  100, 255, 256, 257,  511,  512,  513, 527,
                                528, 529, 600, 767, 768, 775, 992, 1023, 1024, 1025, 1100};

TEST(Fingerprint, EveryWordCounts) {
  std::mt19937_64 random(1);
  for (const std::size_t n : kLengths) {
    Words one = randomWords(n, random), other = randomWords(n % 70, random);
    const Fingerprint before = of(one, other);
    EXPECT_EQ(of(Words(one), Words(other)), before);  // wherever they lie
    for (Words* const words : {&one, &other}) {
      for (std::uint64_t& word : *words) {
        const std::uint64_t bit = std::uint64_t{1} << random() % 64;
        word ^= bit;
        ASSERT_FALSE(of(one, other) == before) << n << " words, at " << &word - words->data();
        word ^= bit;
      }
    }
  }
}

// Lengths that no word divides: those of floats.
TEST(Fingerprint, EveryByteCounts) {
  std::mt19937_64 random(3);
  for (const std::size_t n : kLengths) {
    for (std::size_t bytes = 8 * n + 1; bytes < 8 * n + 8; ++bytes) {
      Words words = randomWords(n + 1, random);
      auto* const at = reinterpret_cast<unsigned char*>(words.data());
      const Fingerprint before = fingerprint(at, bytes, nullptr, 0);
      at[bytes] ^= 1;  // beyond the end
      EXPECT_EQ(fingerprint(at, bytes, nullptr, 0), before);
      at[bytes - 1] ^= 1;
      EXPECT_FALSE(fingerprint(at, bytes, nullptr, 0) == before) << bytes;
    }
  }
}

TEST(Fingerprint, OrderCounts) {
  std::mt19937_64 random(2);
  Words one = randomWords(1500, random), other = randomWords(700, random);
  const Fingerprint before = of(one, other);
  for (int i = 0; i < 3000; ++i) {
    const std::size_t j = random() % one.size(), k = random() % one.size();
    if (j == k) continue;
    std::swap(one[j], one[k]);
    ASSERT_FALSE(of(one, other) == before);
    std::swap(one[j], one[k]);
  }
  // Two blocks, and the two arrays, change places.
  std::swap_ranges(one.begin(), one.begin() + 512, one.begin() + 512);
  EXPECT_FALSE(of(one, other) == before);
  std::swap_ranges(one.begin(), one.begin() + 512, one.begin() + 512);
  EXPECT_FALSE(of(other, one) == before);
  EXPECT_EQ(of(one, other), before);
}

// Meshes that deform by little are like each other: vertices on a grid, one of them moved.
TEST(Fingerprint, NoTwoLikeArraysAgree) {
  std::set<std::pair<std::uint64_t, std::uint64_t>> seen;
  std::vector<double> vertices(3000, 0.0);
  Words other(100, 0);
  std::size_t count = 0;
  for (std::size_t i = 0; i < vertices.size(); ++i) {
    for (const double value : {1.0, -1.0, 2.0, 0.5, 1.0 + 0x1p-52, -0.0}) {
      vertices[i] = value;
      const Fingerprint print =
          fingerprint(vertices.data(), 8 * vertices.size(), other.data(), 8 * other.size());
      seen.emplace(print.first, print.second);
      ++count;
    }
    vertices[i] = 0;
  }
  EXPECT_EQ(seen.size(), count);
}

}  // namespace
}  // namespace kios::engine
