// SPDX-FileCopyrightText: 2026 The fcl_kios authors
// SPDX-License-Identifier: BSD-3-Clause
#include "input.h"

namespace kios::files {

Mesh readOther(const Input& input) {
  input.refuse(nullptr,
               "it is of no kind that is read without assimp; convert it to one that ends in "
               ".stl, .obj, .off or .ply.");
}

}  // namespace kios::files
