// SPDX-FileCopyrightText: 2026 The fcl_kios authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstddef>
#include <cstdint>
#include <string>

#include <fcl/geometry/bvh/BV_node.h>
#include "fcl_kios/volume.h"
#include "volume/errors.h"

#define XXH_INLINE_ALL  // the library links nothing for it
#include <xxhash.h>

namespace kios::stored {

// The file is what memory holds on little-endian machines with these sizes, so that a load copies.
template <typename S>
using Node = fcl::BVNode<kIOS<S>>;
static_assert(sizeof(Node<double>) == 120 && sizeof(Node<float>) == 100);
#if defined(__BYTE_ORDER__) && __BYTE_ORDER__ != __ORDER_LITTLE_ENDIAN__
#error "Stored models are little-endian."
#endif

constexpr char kMagic[8] = {'k', 'i', 'o', 's', 'm', 'e', 's', 'h'};
/// Files of versions 1 and 2 are read for their mesh, which is built anew: their nodes have eight
/// bytes more, and prepared trees may follow.
constexpr std::uint32_t kVersion = 3;

/// After it lie, each on a multiple of 16 bytes and padded with zeros: the nodes, the primitives
/// in the order of the leaves (uint32), the vertices, and the triangles (three uint32 each).
struct Header {
  char magic[8];
  std::uint32_t version, scalar;      ///< sizeof(S)
  std::uint64_t size;                 ///< of all
  std::uint64_t hash_low, hash_high;  ///< XXH3 of all, these two taken as 0
  std::uint32_t num_triangles, num_vertices;
  std::uint32_t num_nodes;  ///< 0 if the mesh has no tree of the ordinary kind
  std::uint32_t older0;     ///< of versions before 3, as `older`; 0
  double cost_density, threshold_occupied, threshold_free;
  std::uint32_t older[4];

  bool isOlder() const { return version < 3; }
};
static_assert(sizeof(Header) == 96);

[[noreturn]] inline void refuseStored(const std::string& what) {
  refuse("the stored model ", what);
}

constexpr std::uint64_t padded(std::uint64_t bytes) { return (bytes + 15) / 16 * 16; }

/// Where each part begins, and all ends.
struct Layout {
  std::uint64_t nodes, primitives, vertices, triangles, end;

  template <typename S>
  static Layout of(const Header& h, S /*scalar*/) {
    const std::uint64_t node = h.isOlder() ? (sizeof(S) == 8 ? 128 : 112) : sizeof(Node<S>);
    Layout at{};
    at.nodes = sizeof(Header);
    at.primitives = at.nodes + padded(h.num_nodes * node);
    at.vertices = at.primitives + padded(h.num_nodes == 0 ? 0 : h.num_triangles * std::uint64_t{4});
    at.triangles = at.vertices + padded(h.num_vertices * std::uint64_t{3 * sizeof(S)});
    at.end = at.triangles + padded(h.num_triangles * std::uint64_t{12});
    return at;
  }
};

/// The hash of a header, its own hash taken as 0, and of the bytes that follow it.
inline XXH128_hash_t hashOf(Header header, const unsigned char* bytes, std::size_t size) {
  header.hash_low = header.hash_high = 0;
  XXH3_state_t state;
  XXH3_128bits_reset(&state);
  XXH3_128bits_update(&state, &header, sizeof(header));
  XXH3_128bits_update(&state, bytes, size);
  return XXH3_128bits_digest(&state);
}

}  // namespace kios::stored
