// SPDX-FileCopyrightText: 2026 The fcl_kios authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstddef>
#include <stdexcept>
#include <string>
#include <vector>

#include <fcl/common/types.h>
#include <fcl/math/triangle.h>

namespace kios::files {

/// All meshes of a file in one frame: at least one triangle, indices in range, finite vertices in
/// the file's units, each as often as the file has it.
struct Mesh {
  std::vector<fcl::Vector3d> vertices;
  std::vector<fcl::Triangle> triangles;  ///< in the file's order; polygons are triangulated
  int parts = 0;                         ///< meshes, each counted as often as it is placed
  /// Nodes that hold meshes, objects of an OBJ or else groups, as the file names them; none where
  /// it has none.
  std::vector<std::string> objects;
  std::vector<int> object_of;         ///< of each triangle; empty without objects
  std::size_t other_faces = 0;        ///< points and lines, left out
  std::vector<std::string> warnings;  ///< a sentence for all that was left out or looks cut off
};

/// A file that isn't there, is a directory or can't be opened.
struct OpenError : std::runtime_error {
  OpenError(const std::string& what, int error_number)
      : std::runtime_error(what), code(error_number) {}
  int code;  ///< as errno
};

/// The content of a regular file. Throws OpenError, or std::invalid_argument where the file is of
/// another kind, empty or larger than `most` bytes.
std::string contentOf(const std::string& file, std::size_t most);

/// Reads STL, OBJ, OFF, PLY and COLLADA (whose unit counts, its up axis does not) in doubles;
/// others by assimp in floats, where it is there, in a process of its own. Throws as contentOf(),
/// and std::invalid_argument for what is no mesh, with a sentence that begins with file and line.
Mesh readMesh(const std::string& file);
/// Reads what a file of that name would hold, of those five kinds.
Mesh readMesh(const std::string& file, std::string content);

/// Makes vertices of equal coordinates one, the first; triangles keep their order.
void weld(Mesh& mesh);

}  // namespace kios::files
