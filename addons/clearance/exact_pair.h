// SPDX-FileCopyrightText: 2026 The fcl_kios authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "clearance/sphere_intersection.h"
#include "fcl_kios/clearance/exact_distance.h"

namespace kios::exact {

/// exactDistance() of volumes that aren't empty and whose bodies were made before.
template <typename S>
ExactDistance exactDistance(const kIOS<S>& a, const SphereIntersection& body_a, const kIOS<S>& b,
                            const SphereIntersection& body_b, const RelativePose<S>& X_AB);

}  // namespace kios::exact
