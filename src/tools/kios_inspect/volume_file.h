// SPDX-FileCopyrightText: 2026 The fcl_kios authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <filesystem>
#include <vector>

#include "painted_mesh.h"

namespace kios::inspect {

/// Whether writeMeshes() knows the file's extension: `.ply` or `.glb`.
bool isMeshFile(const std::filesystem::path& file);

/// Writes meshes for viewers, as PLY (binary, one mesh with a colour a vertex) or GLB (glTF 2.0, a
/// mesh and a material each, with normals), by the file's extension. Coordinates are float. Throws
/// OutputError if it can't.
void writeMeshes(const std::filesystem::path& file, const std::vector<PaintedMesh>& meshes);

/// Writes all of it or throws OutputError.
void writeFile(const std::filesystem::path& file, const std::string& content);

}  // namespace kios::inspect
