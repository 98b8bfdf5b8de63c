// SPDX-FileCopyrightText: 2026 The fcl_kios authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <array>
#include <cstdint>

namespace kios::engine {

/// By the bits of a subset of eight lanes: its lanes in order, then zeros.
inline constexpr auto kLaneOrder = [] {
  std::array<std::array<std::uint8_t, 8>, 256> order{};
  for (unsigned bits = 0; bits < 256; ++bits) {
    unsigned count = 0;
    for (std::uint8_t lane = 0; lane < 8; ++lane) {
      if ((bits >> lane & 1U) != 0) order[bits][count++] = lane;
    }
  }
  return order;
}();

}  // namespace kios::engine
