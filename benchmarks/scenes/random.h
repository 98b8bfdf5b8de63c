// SPDX-FileCopyrightText: 2026 The fcl_kios authors
// SPDX-License-Identifier: BSD-3-Clause

#pragma once

#include <cstdint>
#include <random>

#include <Eigen/Core>

namespace kios::scenes {

/// Seeded random numbers that are the same with every standard library: the engine is specified by
/// the standard, the distributions of <random> are not, so the mapping to doubles is done here.
class Random {
 public:
  explicit Random(std::uint64_t seed) : engine_(seed) {}

  /// Returns a number uniform in [0, 1), a multiple of 2^-53.
  double unit() { return static_cast<double>(engine_() >> 11) * 0x1p-53; }

  /// Returns a number uniform in [lower, upper).
  double uniform(double lower, double upper) { return lower + (upper - lower) * unit(); }

  /// Returns a vector uniform in [lower, upper)^3; x is drawn first.
  Eigen::Vector3d inCube(double lower, double upper) {
    Eigen::Vector3d p;
    for (int c = 0; c < 3; ++c) p[c] = uniform(lower, upper);
    return p;
  }

 private:
  std::mt19937_64 engine_;
};

}  // namespace kios::scenes
