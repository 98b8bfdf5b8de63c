// SPDX-FileCopyrightText: 2026 The fcl_kios authors
// SPDX-License-Identifier: BSD-3-Clause
#include "tree/ownership.h"

#include <algorithm>

#include "volume/large_arrays.h"

namespace kios::engine {
namespace {

constexpr std::uint32_t kNone = ~std::uint32_t{0};

struct Owned {
  std::uint32_t leaf = kNone;
  std::uint32_t first = kNone;  ///< packed FeatureId of its first triangle
};

/// Offers a feature to a leaf, which takes it if it owns clearly less than the owner so far. If the
/// first leaf keeps all, leaves name twice as many pairs: world/table_top/ur5 distance has 0.87 of
/// its speed, world/crate/parts 0.88.
void offer(Owned& feature, std::uint32_t leaf, std::uint32_t packed,
           std::vector<std::uint32_t>& owned_by) {
  feature.first = std::min(feature.first, packed);
  if (feature.leaf == leaf) return;
  if (feature.leaf != kNone) {
    if (owned_by[feature.leaf] <= owned_by[leaf] + 1) return;
    --owned_by[feature.leaf];
  }
  feature.leaf = leaf;
  ++owned_by[leaf];
}

/// Edges by their two vertices; open addressing.
class EdgeTable {
 public:
  explicit EdgeTable(std::size_t expected) {
    std::size_t capacity = 16;
    while (capacity < 2 * expected) capacity *= 2;
    reserveLarge(table_, capacity);
    table_.assign(capacity, kNone);
    reserveLarge(keys_, expected);
    reserveLarge(edges_, expected);
  }

  /// To be called some edges before find(): the table is larger than the caches.
  void prefetch(std::uint32_t a, std::uint32_t b) const {
    __builtin_prefetch(&table_[slotOf(keyOf(a, b))]);
  }

  Owned& find(std::uint32_t a, std::uint32_t b) {
    const std::uint64_t key = keyOf(a, b);
    std::size_t slot = slotOf(key);
    while (table_[slot] != kNone && keys_[table_[slot]] != key) {
      slot = (slot + 1) & (table_.size() - 1);
    }
    if (table_[slot] == kNone) {
      table_[slot] = static_cast<std::uint32_t>(keys_.size());
      keys_.push_back(key);
      edges_.emplace_back();
      if (2 * keys_.size() > table_.size()) grow();
      return edges_.back();
    }
    return edges_[table_[slot]];
  }

  const std::vector<Owned>& edges() const { return edges_; }

 private:
  static std::uint64_t keyOf(std::uint32_t a, std::uint32_t b) {
    return a < b ? std::uint64_t{a} << 32 | b : std::uint64_t{b} << 32 | a;
  }
  std::size_t slotOf(std::uint64_t key) const {
    return (key * 0x9E3779B97F4A7C15U) >> 20 & (table_.size() - 1);
  }

  void grow() {
    table_.assign(2 * table_.size(), kNone);
    for (std::size_t i = 0; i < keys_.size(); ++i) {
      std::size_t slot = slotOf(keys_[i]);
      while (table_[slot] != kNone) slot = (slot + 1) & (table_.size() - 1);
      table_[slot] = static_cast<std::uint32_t>(i);
    }
  }

  std::vector<std::uint32_t> table_;
  std::vector<std::uint64_t> keys_;
  std::vector<Owned> edges_;
};

/// Features grouped by leaf, in the order they were met in.
void group(const std::vector<Owned>& features, std::size_t num_leaves, std::vector<FeatureId>& out,
           std::vector<std::uint32_t>& begin) {
  begin.assign(num_leaves + 1, 0);
  for (const Owned& f : features) {
    if (f.leaf != kNone) ++begin[f.leaf + 1];
  }
  for (std::size_t l = 0; l < num_leaves; ++l) begin[l + 1] += begin[l];
  out.resize(begin.back());
  std::vector<std::uint32_t> at(begin.begin(), begin.end() - 1);
  for (const Owned& f : features) {
    if (f.leaf != kNone) out[at[f.leaf]++] = FeatureId{f.first};
  }
}

}  // namespace

Ownership assignFeatures(const std::vector<Corners3>& corners,
                         const std::vector<std::uint32_t>& order,
                         const std::vector<std::uint32_t>& leaf_begin, std::size_t num_vertices) {
  const std::size_t num_leaves = leaf_begin.size() - 1;
  std::vector<Owned> vertices;
  reserveLarge(vertices, num_vertices);
  vertices.resize(num_vertices);
  const auto isPoint = [](const Corners3& v) { return v[1] == v[0] && v[2] == v[0]; };
  // The edges of points are their vertices.
  const bool points = std::all_of(corners.begin(), corners.end(), isPoint);
  EdgeTable edges(points ? 0 : corners.size() * 3 / 2 + 16);
  std::vector<std::uint32_t> edges_of(num_leaves, 0), vertices_of(num_leaves, 0);
  for (std::uint32_t leaf = 0; leaf < num_leaves; ++leaf) {
    for (std::uint32_t i = leaf_begin[leaf]; i < leaf_begin[leaf + 1]; ++i) {
      constexpr std::uint32_t kAhead = 8;
      if (i + 2 * kAhead < order.size()) __builtin_prefetch(&corners[order[i + 2 * kAhead]]);
      if (i + kAhead < order.size()) {
        const Corners3& next = corners[order[i + kAhead]];
        for (int k = 0; k < 3; ++k) {
          __builtin_prefetch(&vertices[next[k]]);
          if (!points) edges.prefetch(next[k], next[k == 2 ? 0 : k + 1]);
        }
      }
      const std::uint32_t triangle = order[i];
      const Corners3& v = corners[triangle];
      for (std::uint32_t k = 0; k < (points ? 1 : 3); ++k) {
        const std::uint32_t packed = triangle << 2 | k;
        offer(vertices[v[k]], leaf, packed, vertices_of);
        if (!points) offer(edges.find(v[k], v[k == 2 ? 0 : k + 1]), leaf, packed, edges_of);
      }
    }
  }
  Ownership result;
  group(points ? vertices : edges.edges(), num_leaves, result.edges, result.edge_begin);
  group(vertices, num_leaves, result.vertices, result.vertex_begin);
  return result;
}

}  // namespace kios::engine
