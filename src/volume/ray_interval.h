// SPDX-FileCopyrightText: 2026 The fcl_kios authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "fcl_kios/volume.h"

namespace kios {

/// A ray as tests of volumes see it: origin + t direction 2^exponent; coordinates up to 2^1000.
class RayLine {
 public:
  RayLine(const fcl::Vector3d& origin, const fcl::Vector3d& direction, int exponent);

  const fcl::Vector3d& origin() const { return origin_; }
  const fcl::Vector3d& unit() const { return unit_; }

  /// The point of the line that is nearest to `center`, to rounding.
  struct Near {
    double t;               ///< of the scaled direction
    fcl::Vector3d from_it;  ///< from that point to `center`
    double error;           ///< bounds |rounding of from_it|, and that of t times the length
  };
  /// All lengths in units of 2^e.
  Near nearTo(const fcl::Vector3d& center, int e) const;

  /// Between t and lengths from a point at `near_t`, in units of 2^e.
  double lengthOf(double t, double near_t, int e) const;
  double parameterOf(double length, double near_t, int e) const;

 private:
  fcl::Vector3d origin_, direction_, unit_;
  double length_, squared_length_;
  int exponent_;
};

/// Sets bounds of the t for which the line may be in the volume, outwards; false if there are none.
/// Infinite where t exceeds double.
template <typename S>
bool rayInterval(const kIOS<S>& bv, const RayLine& line, double& enter, double& exit);

}  // namespace kios
