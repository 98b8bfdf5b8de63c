// SPDX-FileCopyrightText: 2026 The fcl_kios authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "fcl_kios/volume/kios.h"

namespace kios {

/// Fits a kIOS to n points, in the form that FCL finds by argument-dependent lookup. S0 is nearly
/// minimal; each cap is centred in its plane and has its own radius. n = 0 gives the empty volume.
/// Throws std::invalid_argument if a coordinate is NaN, infinite, or above 2^1000 (double) or 2^120
/// (float) in magnitude. The published fits are in fcl_kios/paper/fit.h.
template <typename S>
void fit(const fcl::Vector3<S>* points, int n, kIOS<S>& bv);

}  // namespace kios
