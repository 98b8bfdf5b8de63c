// SPDX-FileCopyrightText: 2026 The fcl_kios authors
// SPDX-License-Identifier: BSD-3-Clause
#include "tree/weld.h"

#include <cstring>

#include "volume/large_arrays.h"

namespace kios::engine {
namespace {

constexpr std::uint32_t kNotSeen = ~std::uint32_t{0};

template <typename S>
std::uint64_t hash(const fcl::Vector3<S>& p) {
  std::uint64_t h = 0;
  for (int c = 0; c < 3; ++c) {
    const double v = double{p[c]} + 0.0;  // -0 + 0 is +0
    std::uint64_t bits;
    std::memcpy(&bits, &v, sizeof(bits));
    h = (h ^ bits) * 0x9E3779B97F4A7C15U;
    h ^= h >> 32;
  }
  return h;
}

}  // namespace

template <typename S>
std::vector<std::uint32_t> weld(const MeshView<S>& mesh) {
  std::vector<std::uint32_t> first(mesh.num_vertices, kNotSeen);
  std::size_t capacity = 16;
  while (capacity < 2 * mesh.num_vertices) capacity *= 2;
  std::vector<std::uint32_t> table;  // open addressing, linear probing
  reserveLarge(table, capacity);
  table.assign(capacity, kNotSeen);
  for (std::size_t t = 0; t < mesh.num_triangles; ++t) {
    constexpr std::size_t kAhead = 8;  // the table is larger than the caches
    for (int k = 0; k < 3 && t + kAhead < mesh.num_triangles; ++k) {
      if (first[mesh.index(t + kAhead, k)] != kNotSeen) continue;
      __builtin_prefetch(&table[hash(mesh.corner(t + kAhead, k)) & (capacity - 1)]);
    }
    for (int k = 0; k < 3; ++k) {
      const std::size_t v = mesh.index(t, k);
      if (first[v] != kNotSeen) continue;
      const fcl::Vector3<S>& p = mesh.vertices[v];
      std::size_t slot = hash(p) & (capacity - 1);
      while (table[slot] != kNotSeen && mesh.vertices[table[slot]] != p) {
        slot = (slot + 1) & (capacity - 1);
      }
      if (table[slot] == kNotSeen) table[slot] = static_cast<std::uint32_t>(v);
      first[v] = table[slot];
    }
  }
  return first;
}

template std::vector<std::uint32_t> weld(const MeshView<double>&);
template std::vector<std::uint32_t> weld(const MeshView<float>&);

}  // namespace kios::engine
