// SPDX-FileCopyrightText: 2026 The fcl_kios authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "fcl_kios/model/model.h"
#include "fcl_kios/search/counts.h"
#include "triangle/ray_crossing.h"

namespace kios {

/// Returns the direction of the rays that count: along no edge or face of ordinary meshes, so that
/// the exact stages are rarely needed.
inline fcl::Vector3d windingDirection() { return {0.36602540378443865, 0.61803398874989485, 1}; }

/// Says where a point lies relative to a closed oriented mesh.
struct PointPlace {
  bool on_surface = false;
  int winding = 0;  ///< the number of times that the mesh winds round the point, off the surface

  bool inside() const { return on_surface || winding > 0; }
  /// Counts how a ray from the point passes a triangle. Returns on_surface, at which nothing else
  /// matters.
  bool add(Crossing crossing) {
    winding += crossing == Crossing::kForward ? 1 : 0;
    winding -= crossing == Crossing::kBackward ? 1 : 0;
    on_surface |= crossing == Crossing::kOrigin;
    return on_surface;
  }
};

/// Decides exactly, for a point in the model's frame; one ray through the model's tree.
template <typename S>
PointPlace placeOf(const fcl::Vector3d& point, const Model<S>& model, SearchCounts& counts);

}  // namespace kios
