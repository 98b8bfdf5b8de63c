// SPDX-FileCopyrightText: 2026 The fcl_kios authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "fcl_kios/bv/kios.h"

namespace kios {

/// How spheres are fitted to points.
enum class FitMethod {
  kTuned,     ///< Near-minimal S0; each cap re-centred in its plane, with its own radius (default).
  kMethodII,  ///< As published: PCA, caps at pi/6, k by the ratio 1.5, the shift (paper, III-B, C).
};

/// Fits a kIOS to n points. n = 0 gives the empty volume. Throws std::invalid_argument if a
/// coordinate is NaN, infinite, or above 2^1000 (double) or 2^120 (float) in magnitude.
template <typename S>
void fit(const fcl::Vector3<S>* points, int n, kIOS<S>& bv, FitMethod method);

/// The tuned fit, in the form that FCL finds by argument-dependent lookup.
template <typename S>
void fit(const fcl::Vector3<S>* points, int n, kIOS<S>& bv) {
  fit(points, n, bv, FitMethod::kTuned);
}

}  // namespace kios
