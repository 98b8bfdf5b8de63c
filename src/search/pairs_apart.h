// SPDX-FileCopyrightText: 2026 The fcl_kios authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <array>
#include <cstdint>
#include <optional>

#include "search/mesh_pair.h"

namespace kios::engine {

/// Remembers some triangles that don't intersect: those that nearly touch are named by many of
/// their features, and by edges that may cross faces.
class PairsApart {
 public:
  /// Asks the triangles, unless they are known.
  bool intersect(const MeshPair& pair, const TrianglePairIds& ids) {
    if (!known_) known_.emplace();
    const auto a = static_cast<std::uint32_t>(ids.a), b = static_cast<std::uint32_t>(ids.b);
    TrianglePairIds& known = (*known_)[(a * 0x9E3779B1U + b * 0x85EBCA6BU) >> (32 - kBits)];
    if (known == ids) return false;
    if (pair.intersect(ids)) return true;
    known = ids;
    return false;
  }

 private:
  static constexpr std::uint32_t kBits = 6, kNumber = 1U << kBits;
  std::optional<std::array<TrianglePairIds, kNumber>> known_;  // most searches need none
};

}  // namespace kios::engine
