// SPDX-FileCopyrightText: 2026 The fcl_kios authors
// SPDX-License-Identifier: BSD-3-Clause
#include "input.h"

namespace kios::files {

Mesh readOther(const Input& input) {
  input.refuse(nullptr,
               "names that end in .stl, .obj, .off and .ply are read; others need assimp, "
               "without which this was built (Debian: libassimp-dev).");
}

}  // namespace kios::files
