// SPDX-FileCopyrightText: 2026 The fcl_kios authors
// SPDX-License-Identifier: BSD-3-Clause

#pragma once

#include <filesystem>

#include "arms.h"

namespace kios::scenes {

/// Returns true if the data folder holds the UR5's meshes.
bool holdsUr5(const std::filesystem::path& data);

/// Returns the UR5 of the data folder: base and 6 links, equal vertices welded. Throws as
/// loadMesh(), naming the file and what is wrong with it.
Robot loadUr5(const std::filesystem::path& data);

}  // namespace kios::scenes
