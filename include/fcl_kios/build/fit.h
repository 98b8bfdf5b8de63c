// SPDX-FileCopyrightText: 2026 The fcl_kios authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "fcl_kios/volume/kios.h"

namespace kios {

/// Names the method by which spheres are fitted to points.
enum class FitMethod {
  kTuned,    ///< Near-minimal S0; each cap re-centred in its plane, with its own radius (default).
  kMethodI,  ///< Caps from the curvature of the smallest enclosing ellipsoid (paper, III-B.1).
  kMethodIAtAngle,  ///< As Method I, its shortest semi-axis taken as a sin(angle) at least.
  kMethodII,  ///< As published: PCA, caps at pi/6, k by the ratio 1.5, the shift (paper, III-B.2).
};

/// Decides how many spheres a volume gets.
enum class SphereCount {
  kByRatio,  ///< 1, 3 or 5 by a/c and a/b against 1.5 (paper, III-C), the tuned fit against 1.1.
  kAll,      ///< Always 5.
  kByGain,   ///< A pair of caps where it takes 10 % or more off S0's extent along the pair's axis.
};

/// Holds the method, and what the paper leaves to choose as well.
struct FitOptions {
  FitOptions(FitMethod fit_method = FitMethod::kTuned) : method(fit_method) {}

  FitMethod method;
  SphereCount count = SphereCount::kByRatio;
  /// All caps get the largest of their radii and move outwards by what they gain, so that each
  /// still touches the content (paper, end of III-B).
  bool shared_radius = false;
  /// Is half the opening angle of a cap over the rim of the box, in [1/256, pi/2); without meaning
  /// in kMethodI. A smaller angle gives larger spheres. Paper, III-B.2: pi/6.
  double angle = kPublishedAngle;

  /// Returns true if this is the tuned fit without changes.
  bool plain() const {
    return method == FitMethod::kTuned && count == SphereCount::kByRatio && !shared_radius &&
           angle == kPublishedAngle;
  }

  static constexpr double kPublishedAngle = 0.52359877559829887;  // pi / 6
};

/// Fits a kIOS to n points. n = 0 gives the empty volume. Throws std::invalid_argument if a
/// coordinate is NaN, infinite, or above 2^1000 (double) or 2^120 (float) in magnitude, or if the
/// angle is out of range.
template <typename S>
void fit(const fcl::Vector3<S>* points, int n, kIOS<S>& bv, const FitOptions& options);

/// Fits by the tuned method, in the form that FCL finds by argument-dependent lookup.
template <typename S>
void fit(const fcl::Vector3<S>* points, int n, kIOS<S>& bv) {
  fit(points, n, bv, FitMethod::kTuned);
}

}  // namespace kios
