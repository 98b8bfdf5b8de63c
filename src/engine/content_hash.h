// SPDX-FileCopyrightText: 2026 The fcl_kios authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>

#include "engine/mesh.h"

namespace kios::engine {

/// 128 bits of a mesh's arrays, by which meshes of equal content find each other. Two meshes that
/// differ in any bit of a vertex, an index, a count or their scalar share a hash with probability
/// 2^-128: the seed is drawn anew by each process. Nobody compares the arrays themselves, since
/// those of a model are its owner's, who may write them at any time.
struct ContentHash {
  std::uint64_t low = 0, high = 0;

  bool operator==(const ContentHash& o) const { return low == o.low && high == o.high; }
};

/// Takes 1 to 3 ns a triangle, where a build takes 600.
template <typename S>
ContentHash contentHash(const MeshView<S>& mesh);

/// For unordered containers.
struct HashOfContent {
  std::size_t operator()(const ContentHash& hash) const {
    return static_cast<std::size_t>(hash.low);
  }
};

}  // namespace kios::engine
