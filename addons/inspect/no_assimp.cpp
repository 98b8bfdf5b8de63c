// SPDX-FileCopyrightText: 2026 The fcl_kios authors
// SPDX-License-Identifier: BSD-3-Clause
#include "mesh_file.h"

namespace kios::inspect {

Mesh readMesh(const std::filesystem::path& file) {
  throw InputError(file.string() +
                   ": this kios_inspect was built without assimp and reads no files; install "
                   "libassimp-dev, then configure and build it again.");
}

}  // namespace kios::inspect
