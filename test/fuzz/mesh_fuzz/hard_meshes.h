// SPDX-FileCopyrightText: 2026 The fcl_kios authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "fuzz/mesh_fuzz/fuzz_case.h"

namespace kios::fuzz {

/// A mesh of any nasty kind, of 1 to 60 triangles but for a few, of extent about 1: lattices, rods
/// of specks, slivers, flat and degenerate ones, mixed scales, closed shapes, copies of triangles.
Mesh hardMesh(Random& random);

/// Returns a relative of a mesh: it again, a smaller one about the same centre, turned inside out,
/// noisy, a part of it.
Mesh relativeOf(const Mesh& mesh, Random& random);

/// All vertices times `scale`, then moved by `offset`; rounded as doubles do.
void place(Mesh& mesh, double scale, const Vector3d& offset);

/// Returns the middle of the mesh's box, rounded.
Vector3d middleOf(const Mesh& mesh);

/// Returns the mesh of only these triangles, without the vertices that it then doesn't use.
Mesh partOf(const Mesh& mesh, const std::vector<std::size_t>& triangles);

}  // namespace kios::fuzz
