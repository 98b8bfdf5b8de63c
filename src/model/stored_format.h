// SPDX-FileCopyrightText: 2026 The fcl_kios authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstddef>
#include <cstdint>
#include <string>

#include <fcl/geometry/bvh/BV_node.h>
#include "fcl_kios/volume/kios.h"
#include "tree/tree.h"
#include "volume/errors.h"

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
constexpr std::uint32_t kVersion = 2;

/// After it lie, each on a multiple of 16 bytes and padded with zeros: the nodes, the primitives
/// in the order of the leaves (uint32), the vertices, the triangles (three uint32 each), and since
/// version 2 the prepared tree, if there is one: PreparedValues and the arrays of engine::Tree as
/// they are, but for its blocks, which follow from its nodes.
struct Header {
  char magic[8];
  std::uint32_t version, scalar;      ///< sizeof(S)
  std::uint64_t size;                 ///< of all
  std::uint64_t hash_low, hash_high;  ///< XXH3 of all, these two taken as 0
  std::uint32_t num_triangles, num_vertices;
  std::uint32_t num_nodes;  ///< 0 if the mesh has no tree of the ordinary kind
  // These count the prepared tree, and are 0 if there is none, as in version 1.
  std::uint32_t num_leaves;
  double cost_density, threshold_occupied, threshold_free;
  std::uint32_t num_blocks, num_lanes, num_features;
  std::uint32_t parts;  ///< kBoxes and kCorners: the arrays that not every tree has

  static constexpr std::uint32_t kBoxes = 1, kCorners = 2;

  bool hasPrepared() const { return num_leaves != 0; }
  /// Every node of the prepared tree is a leaf or has a block.
  std::uint64_t preparedNodes() const { return std::uint64_t{num_leaves} + num_blocks; }
};
static_assert(sizeof(Header) == 96);

/// What a prepared tree holds beside arrays.
struct PreparedValues {
  double origin[3];
  double cost;
  float reach, mean_leaf, widest_leaf;
  std::uint32_t unused[5];
  engine::Box root_box;
};
static_assert(sizeof(PreparedValues) == 128 && offsetof(PreparedValues, root_box) == 64 &&
              sizeof(engine::Children) == 3 && sizeof(engine::Leaf) == 116 &&
              sizeof(engine::FeatureId) == 4 && sizeof(engine::Corners3) == 12);

[[noreturn]] inline void refuseStored(const std::string& what) {
  refuse("the stored model ", what);
}

constexpr std::uint64_t padded(std::uint64_t bytes) { return (bytes + 15) / 16 * 16; }

/// Where each part begins.
struct Layout {
  std::uint64_t nodes, primitives, vertices, triangles, prepared, prepared_nodes, boxes, children,
      leaves, lanes, features, corners, size;

  template <typename S>
  static Layout of(const Header& h, S /*scalar*/) {
    Layout at{};
    at.nodes = sizeof(Header);
    at.primitives = at.nodes + padded(h.num_nodes * std::uint64_t{sizeof(Node<S>)});
    at.vertices = at.primitives + padded(h.num_nodes == 0 ? 0 : h.num_triangles * std::uint64_t{4});
    at.triangles = at.vertices + padded(h.num_vertices * std::uint64_t{3 * sizeof(S)});
    at.prepared = at.triangles + padded(h.num_triangles * std::uint64_t{12});
    at.prepared_nodes = at.prepared + (h.hasPrepared() ? sizeof(PreparedValues) : 0);
    at.boxes = at.prepared_nodes + h.preparedNodes() * sizeof(engine::Node);
    at.children =
        at.boxes + (h.parts & Header::kBoxes ? h.preparedNodes() * sizeof(engine::Box) : 0);
    at.leaves = at.children + padded(h.num_blocks * std::uint64_t{sizeof(engine::Children)});
    at.lanes = at.leaves + padded(h.num_leaves * std::uint64_t{sizeof(engine::Leaf)});
    at.features = at.lanes + h.num_lanes * std::uint64_t{sizeof(engine::Lanes)};
    at.corners = at.features + padded(h.num_features * std::uint64_t{sizeof(engine::FeatureId)});
    at.size = at.corners + (h.parts & Header::kCorners
                                ? padded(h.num_triangles * std::uint64_t{sizeof(engine::Corners3)})
                                : 0);
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
