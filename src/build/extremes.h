// SPDX-FileCopyrightText: 2026 The fcl_kios authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstddef>

#include "build/lane_fit.h"

namespace kios::engine {

/// The points of a set that lie farthest along the axes and the diagonals of a cube, each once.
/// They stand for a large set where spheres are placed, never where radii are measured.
struct Extremes {
  static constexpr int kDirections = 13;  ///< half of the 26
  static constexpr int kMost = 2 * kDirections;
  int count = 0;
  float x[kMost], y[kMost], z[kMost];

  void move(const float (&by)[3]);
};

Extremes extremesOf(const PointQuad* quads, std::size_t n);

}  // namespace kios::engine
