// SPDX-FileCopyrightText: 2026 The fcl_kios authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "search/mesh.h"

namespace kios {

/// The vertex that lies farthest along n, which is not zero: no other is farther by more than 2^-47
/// |n| mesh.largest().
fcl::Vector3d farthestVertex(const Mesh& mesh, const fcl::Vector3d& n);

}  // namespace kios
