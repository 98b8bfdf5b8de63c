// SPDX-FileCopyrightText: 2026 The fcl_kios authors
// SPDX-License-Identifier: BSD-3-Clause
#include "tree/content_hash.h"

#include <chrono>
#include <cstring>
#include <exception>
#include <random>

#define XXH_INLINE_ALL  // the library links nothing for it
#include <xxhash.h>

namespace kios::engine {
namespace {

__extension__ typedef unsigned __int128 Wide;  // NOLINT(modernize-use-using)

constexpr std::uint64_t kPrime = (std::uint64_t{1} << 61) - 1;

/// x modulo the prime, for x < 2^122.
std::uint64_t reduced(Wide x) {
  const std::uint64_t sum =
      (static_cast<std::uint64_t>(x) & kPrime) + static_cast<std::uint64_t>(x >> 61);
  return sum >= kPrime ? sum - kPrime : sum;
}

std::uint64_t drawn() {
  try {
    std::random_device device;
    return std::uint64_t{device()} << 32 | device();
  } catch (const std::exception&) {  // a system without a source of them
    return static_cast<std::uint64_t>(std::chrono::steady_clock::now().time_since_epoch().count());
  }
}

struct Seeds {
  std::uint64_t hash = drawn(), point = 1 + drawn() % (kPrime - 1);
};
const Seeds& seeds() {
  static const Seeds of_process;
  return of_process;
}

/// Horner's rule over words below the prime, continued from `sum`: each word, and `sum`, gets a
/// power of the point to itself. Eight sums run at once, each over every eighth word.
template <typename Word>
std::uint64_t polynomial(std::uint64_t sum, const void* data, std::size_t bytes) {
  constexpr std::size_t kSums = 8;
  const auto* at = static_cast<const unsigned char*>(data);
  const std::uint64_t point = seeds().point;
  std::uint64_t step = 1;
  for (std::size_t i = 0; i < kSums; ++i) step = reduced(Wide{step} * point);
  std::uint64_t sums[kSums] = {sum};
  std::size_t left = bytes / sizeof(Word);
  for (; left >= kSums; left -= kSums, at += kSums * sizeof(Word)) {
    Word words[kSums];
    std::memcpy(words, at, sizeof(words));
    for (std::size_t i = 0; i < kSums; ++i) sums[i] = reduced(Wide{sums[i]} * step + words[i]);
  }
  std::uint64_t all = 0;
  for (const std::uint64_t part : sums) all = reduced(Wide{all} * point + part);
  for (; left > 0; --left, at += sizeof(Word)) {
    Word word;
    std::memcpy(&word, at, sizeof(word));
    all = reduced(Wide{all} * point + word);
  }
  return all;
}

}  // namespace

template <typename S>
ContentHash contentHash(const MeshView<S>& mesh) {
  static_assert(sizeof(fcl::Vector3<S>) == 3 * sizeof(S));
  const std::size_t vertex_bytes = mesh.num_vertices * sizeof(*mesh.vertices);
  const std::size_t triangle_bytes = mesh.num_triangles * sizeof(*mesh.triangles);
  const std::uint64_t seed = seeds().hash;
  const struct {
    XXH128_hash_t vertices, triangles;
    std::uint64_t num_vertices, num_triangles, scalar;
  } parts = {XXH3_128bits_withSeed(mesh.vertices, vertex_bytes, seed),
             XXH3_128bits_withSeed(mesh.triangles, triangle_bytes, ~seed), mesh.num_vertices,
             mesh.num_triangles, sizeof(S)};
  static_assert(sizeof(parts) == 56, "no padding, whose bytes are any");
  const XXH128_hash_t all = XXH3_128bits_withSeed(&parts, sizeof(parts), seed);
  // The counts are first, so that no two meshes have the same words.
  std::uint64_t sum = polynomial<std::uint64_t>(0, &parts.num_vertices, 3 * sizeof(std::uint64_t));
  sum = polynomial<std::uint32_t>(sum, mesh.vertices, vertex_bytes);
  return {all.low64, all.high64, polynomial<std::uint64_t>(sum, mesh.triangles, triangle_bytes)};
}

template ContentHash contentHash(const MeshView<double>&);
template ContentHash contentHash(const MeshView<float>&);

}  // namespace kios::engine
