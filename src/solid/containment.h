// SPDX-FileCopyrightText: 2026 The fcl_kios authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <array>
#include <optional>

#include "fcl_kios/detail/counts.h"
#include "search/mesh_pair.h"
#include "triangle/ray_crossing.h"

namespace kios {

/// Where a point lies relative to a closed oriented mesh.
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

/// Decides exactly, for a point in the mesh's frame; one ray through the mesh's tree.
PointPlace placeOf(const fcl::Vector3d& point, const Mesh& mesh, SearchCounts& counts);

/// Returns a point of a's or b's surface, in a's frame, that lies in the other solid; none if no
/// component of either lies in the other. Both must be solids, and their surfaces disjoint in the
/// common frame: then it is exact in that frame, since a component is in the other solid with all
/// of its points or with none.
std::optional<fcl::Vector3d> containedPoint(const MeshPair& frame, SearchCounts& counts);

/// Which components of a solid lie in another.
struct Contained {
  bool some = false, all = false;
  bool inwards = false;  ///< one that encloses a negative volume does
};
/// Says so of a's and of b's, as containedPoint() finds the first.
std::array<Contained, 2> containedComponents(const MeshPair& frame);

/// A bound of |y - x| for the point x of b that the common frame's exact pose, entries as they are
/// stored, takes to a point p, |p|_1 <= norm1, and y = R^T (p - T) as double computes it.
double inverseError(const RelativePose<double>& X_AB, double norm1);

/// R^T (p - T), in double.
fcl::Vector3d toB(const RelativePose<double>& X_AB, const fcl::Vector3d& p);

}  // namespace kios
