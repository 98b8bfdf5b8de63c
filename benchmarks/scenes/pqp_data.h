// SPDX-FileCopyrightText: 2026 The fcl_kios authors
// SPDX-License-Identifier: BSD-3-Clause

#pragma once

#include <filesystem>
#include <optional>
#include <vector>

#include "mesh.h"
#include "motions.h"

// The rigid benchmarks of the k-IOS paper, in the PQP distribution's file formats. The project
// ships none of this data; data/README.md of the data folder describes it. A file that can't be
// read is named by a std::runtime_error.

namespace kios::scenes {

/// Returns the data folder: $KIOS_DATA if set, else ../shared/data seen from the current folder,
/// else the same seen from the source tree; nothing if the one so found is not a folder with `pqp`
/// in it.
std::optional<std::filesystem::path> findData();

/// Holds two meshes on their way, in the world frame.
struct MovingPair {
  Mesh a;
  Mesh b;
  std::vector<Frame> frames;
};

/// Loads A = bent torus (torus1), B = knobby torus (torus2), 2398 frames, 392 of them in contact.
MovingPair loadFalling(const std::filesystem::path& data);

/// Loads A = bunny, B = torus; the first `frames` frames of spinningMotion(), never in contact.
MovingPair loadSpinning(const std::filesystem::path& data, int frames);

}  // namespace kios::scenes
