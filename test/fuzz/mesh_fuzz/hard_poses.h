// SPDX-FileCopyrightText: 2026 The fcl_kios authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "fuzz/mesh_fuzz/fuzz_case.h"

namespace kios::fuzz {

/// Returns a pose of b in a's frame: the identity, offset by next to nothing, turned about a common
/// centre, lattice poses, touching or nearly so, apart. `size`: the meshes' extent.
Transform3d hardPose(const Mesh& a, const Mesh& b, double size, Random& random);

/// Returns a pose of all in the world: mostly the identity, else turned, far off, with a matrix
/// that is a rotation to a few digits only.
Transform3d hardWorld(double size, Random& random);

/// Rounds the matrices of a frame to six digits, or disturbs them by up to 3e-5, for all poses.
void blurRotations(std::vector<Transform3d>& poses, Random& random);

/// Returns the body at X moved and turned by any amount up to about `size`.
Transform3d moved(const Transform3d& X, const Vector3d& middle, double size, Random& random);

}  // namespace kios::fuzz
