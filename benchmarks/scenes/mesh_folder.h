// SPDX-FileCopyrightText: 2026 The fcl_kios authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <filesystem>
#include <vector>

#include "arms.h"

// A robot of one's own, from the meshes of its links.

namespace kios::scenes {

/// Returns a file's mesh by addons/files, equal vertices welded. Throws as files::readMesh().
Mesh loadMesh(const std::filesystem::path& file);

/// Returns the meshes of a folder's STL and OBJ files, by name. Throws likewise, and
/// std::runtime_error that names the folder if it holds none.
std::vector<Mesh> loadMeshes(const std::filesystem::path& folder);

/// Returns the meshes as links of an arm, in their order: each with the longest side of its box
/// along the arm, from joint to joint, the joints twisting and bending in turn. All that is known
/// of the robot are its sizes.
Robot chainOf(const std::vector<Mesh>& meshes);

/// Returns the length of the chain when stretched.
double chainLength(const Robot& chain);

}  // namespace kios::scenes
