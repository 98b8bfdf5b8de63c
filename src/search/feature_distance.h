// SPDX-FileCopyrightText: 2026 The fcl_kios authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <Eigen/Core>

#include "triangle/face_plane.h"

namespace kios::engine {

/// Distance of two features by a pair of their points, and what its error scales with.
struct FeatureDistance {
  double distance;  ///< right to a few 2^-53 of `extent`; never below the exact one by more
  double extent;
};

/// Two vertices in which edges were nearest, and from which both led away: not square to the line
/// between, so that no rounding can move the nearest points.
struct NearestEnds {
  Eigen::Vector3d p, q;
  double distance = -1;  ///< < 0: none yet
};

/// Edges p0 p1 and q0 q1, of any length. Sets `ends` if they are nearest in two such ends.
FeatureDistance edgeDistance(const Eigen::Vector3d& p0, const Eigen::Vector3d& p1,
                             const Eigen::Vector3d& q0, const Eigen::Vector3d& q1,
                             NearestEnds& ends);

/// True if these edges too end in those vertices and lead away, as most do that a search finds
/// equally near: edgeDistance() would give the same distance, bit for bit.
bool nearestAt(const NearestEnds& ends, const Eigen::Vector3d& p0, const Eigen::Vector3d& p1,
               const Eigen::Vector3d& q0, const Eigen::Vector3d& q1);

/// A point and the inside of a triangle; infinity if the point projects outside (the edges then are
/// as near), or if the triangle has no plane.
FeatureDistance faceDistance(const FacePlane& face, const Eigen::Vector3d& point);

}  // namespace kios::engine
