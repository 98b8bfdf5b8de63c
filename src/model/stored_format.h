// SPDX-FileCopyrightText: 2026 The fcl_kios authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstddef>
#include <cstdint>
#include <stdexcept>
#include <string>

#include <fcl/geometry/bvh/BV_node.h>
#include "fcl_kios/volume/kios.h"

#define XXH_INLINE_ALL  // the library links nothing for it
#include <xxhash.h>

namespace kios::stored {

// The file is what memory holds on little-endian machines with these sizes, so that a load copies.
template <typename S>
using Node = fcl::BVNode<kIOS<S>>;
static_assert(sizeof(Node<double>) == 128 && sizeof(Node<float>) == 112);
#if defined(__BYTE_ORDER__) && __BYTE_ORDER__ != __ORDER_LITTLE_ENDIAN__
#error "Stored models are little-endian."
#endif

constexpr char kMagic[8] = {'k', 'i', 'o', 's', 'm', 'e', 's', 'h'};
constexpr std::uint32_t kVersion = 1;

/// After it lie, each on a multiple of 16 bytes and padded with zeros: the nodes, the primitives
/// in the order of the leaves (uint32), the vertices, the triangles (three uint32 each).
struct Header {
  char magic[8];
  std::uint32_t version, scalar;      ///< sizeof(S)
  std::uint64_t size;                 ///< of all
  std::uint64_t hash_low, hash_high;  ///< XXH3 of all, these two taken as 0
  std::uint32_t num_triangles, num_vertices;
  std::uint32_t num_nodes;  ///< 0 if the mesh has no tree of the ordinary kind
  std::uint32_t unused;
  double cost_density, threshold_occupied, threshold_free;
  std::uint64_t unused_too[2];
};
static_assert(sizeof(Header) == 96);

[[noreturn]] inline void refuse(const std::string& what) {
  throw std::invalid_argument("fcl_kios: the stored model " + what);
}

constexpr std::uint64_t padded(std::uint64_t bytes) { return (bytes + 15) / 16 * 16; }

/// Where each part begins.
struct Layout {
  std::uint64_t nodes, primitives, vertices, triangles, size;

  template <typename S>
  static Layout of(const Header& h, S /*scalar*/) {
    Layout at{};
    at.nodes = sizeof(Header);
    at.primitives = at.nodes + padded(h.num_nodes * std::uint64_t{sizeof(Node<S>)});
    at.vertices = at.primitives + padded(h.num_nodes == 0 ? 0 : h.num_triangles * std::uint64_t{4});
    at.triangles = at.vertices + padded(h.num_vertices * std::uint64_t{3 * sizeof(S)});
    at.size = at.triangles + padded(h.num_triangles * std::uint64_t{12});
    return at;
  }
};

/// The hash of a header and of what is added after it.
class Hash {
 public:
  explicit Hash(Header header) {
    header.hash_low = header.hash_high = 0;
    XXH3_128bits_reset(&state_);
    add(&header, sizeof(header));
  }
  void add(const void* bytes, std::size_t size) { XXH3_128bits_update(&state_, bytes, size); }

  void writeTo(Header& header) const {
    const XXH128_hash_t hash = XXH3_128bits_digest(&state_);
    header.hash_low = hash.low64;
    header.hash_high = hash.high64;
  }
  bool isOf(const Header& header) const {
    Header hashed{};
    writeTo(hashed);
    return hashed.hash_low == header.hash_low && hashed.hash_high == header.hash_high;
  }

 private:
  XXH3_state_t state_;
};

}  // namespace kios::stored
