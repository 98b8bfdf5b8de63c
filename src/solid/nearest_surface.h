// SPDX-FileCopyrightText: 2026 The fcl_kios authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "fcl_kios/model/model.h"
#include "volume/rounding.h"

namespace kios {

/// Holds the surface of a model about a point.
struct NearestSurface {
  double lower = 0;          ///< no point of the surface is nearer: rounding is paid for
  double upper = kInfinity;  ///< distance of `point`; infinite: none
  fcl::Vector3d point = fcl::Vector3d::Zero();
};

/// Searches for a point in the model's frame: lower >= upper (1 - rel_err) but for rounding, or
/// lower >= required, at which the search ends. It also ends once `upper` is below `ignored_below`;
/// lower is then 0.
template <typename S>
NearestSurface nearestSurface(const Model<S>& model, const fcl::Vector3d& p, double rel_err,
                              double required = kInfinity, double ignored_below = 0);

/// Returns what `lower` pays for rounding.
template <typename S>
double surfaceError(const Model<S>& model, const fcl::Vector3d& p);

}  // namespace kios
