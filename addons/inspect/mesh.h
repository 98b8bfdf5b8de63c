// SPDX-FileCopyrightText: 2026 The fcl_kios authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <stdexcept>
#include <vector>

#include <fcl/common/types.h>
#include <fcl/math/triangle.h>

namespace kios::inspect {

/// Holds all meshes of a file in one frame: at least one triangle, indices in range, finite
/// vertices. Units are the file's.
struct Mesh {
  std::vector<fcl::Vector3d> vertices;
  std::vector<fcl::Triangle> triangles;
  int parts = 0;                ///< meshes of the file, each counted as often as it is placed
  std::size_t other_faces = 0;  ///< points and lines, left out
};

/// Tells of a file that can't be read, or whose content is not a mesh.
struct InputError : std::runtime_error {
  using std::runtime_error::runtime_error;
};

/// Tells of a file that can't be written.
struct OutputError : std::runtime_error {
  using std::runtime_error::runtime_error;
};

}  // namespace kios::inspect
