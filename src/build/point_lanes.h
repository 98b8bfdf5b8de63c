// SPDX-FileCopyrightText: 2026 The fcl_kios authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <algorithm>
#include <cstdint>
#include <cstring>
#include <memory>

#include "volume/lanes.h"

namespace kios {

/// Points as three arrays of floats, padded to whole lanes by repeating the first point. Small sets
/// need no memory of their own, so that a fit of one can make its arrays anew.
class PointLanes {
 public:
  PointLanes() = default;
  PointLanes(const PointLanes&) = delete;

  struct Farthest {
    int index;
    float squared_distance;
  };

  /// The points are lost.
  void resize(int n) {
    const int padded = (n + 3) & ~3;
    if (padded > capacity_) {
      const std::size_t capacity = static_cast<std::size_t>(padded) * 3 / 2 + 64;
      large_.reset(new float[3 * capacity]);
      capacity_ = static_cast<int>(capacity);
      x_ = large_.get();
      y_ = x_ + capacity;
      z_ = y_ + capacity;
    }
    n_ = n;
    padded_ = padded;
  }

  int size() const { return n_; }
  int paddedSize() const { return padded_; }
  float* x() { return x_; }
  float* y() { return y_; }
  float* z() { return z_; }
  const float* x() const { return x_; }
  const float* y() const { return y_; }
  const float* z() const { return z_; }

  void set(int i, float px, float py, float pz) {
    x_[i] = px;
    y_[i] = py;
    z_[i] = pz;
  }
  /// To be called once all n points are set.
  void pad() {
    for (int i = n_; i < padded_; ++i) set(i, x_[0], y_[0], z_[0]);
  }

  /// The point farthest from (cx, cy, cz), the first of several.
  Farthest farthest(float cx, float cy, float cz) const {
    using namespace lanes;  // NOLINT(google-build-using-namespace): local to one kernel
    Float4 best = broadcast(0.0F);
    Int4 at = {0, 1, 2, 3}, best_at = at;
    for (int i = 0; i < padded_; i += 4) {
      const Float4 dx = load(&x_[i]) - cx, dy = load(&y_[i]) - cy, dz = load(&z_[i]) - cz;
      const Float4 d2 = dx * dx + dy * dy + dz * dz;
      const Int4 farther = d2 > best;
      best = max(best, d2);
      best_at = (farther & at) | (~farther & best_at);
      at += 4;
    }
    // Squares order like their bits; of equal ones the smallest index wins.
    std::uint64_t winner = 0;
    for (int l = 0; l < 4; ++l) {
      const float square = best[l];
      std::uint32_t bits;
      std::memcpy(&bits, &square, sizeof(bits));
      winner =
          std::max(winner, std::uint64_t{bits} << 32 | ~static_cast<std::uint32_t>(best_at[l]));
    }
    const int index = static_cast<int>(~static_cast<std::uint32_t>(winner));
    const auto bits = static_cast<std::uint32_t>(winner >> 32);
    Farthest far = {index < n_ ? index : 0, 0};  // padding repeats point 0
    std::memcpy(&far.squared_distance, &bits, sizeof(bits));
    return far;
  }

 private:
  static constexpr int kSmall = 64;
  float small_[3][kSmall];
  std::unique_ptr<float[]> large_;
  float *x_ = small_[0], *y_ = small_[1], *z_ = small_[2];
  int capacity_ = kSmall, n_ = 0, padded_ = 0;
};

}  // namespace kios
