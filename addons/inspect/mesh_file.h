// SPDX-FileCopyrightText: 2026 The fcl_kios authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <filesystem>

#include "mesh.h"

namespace kios::inspect {

/// Reads all meshes of a file, each placed by the transforms of its scene. Throws InputError, with
/// a sentence that names the file and what is wrong: missing, unreadable, no format that assimp
/// knows, no triangles, a vertex that is not finite.
Mesh readMesh(const std::filesystem::path& file);

}  // namespace kios::inspect
