// SPDX-FileCopyrightText: 2026 The fcl_kios authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <stdexcept>

#include "files/read_mesh.h"

namespace kios::inspect {

using files::Mesh;

/// Tells of a file that can't be read, or whose content is not a mesh.
struct InputError : std::runtime_error {
  using std::runtime_error::runtime_error;
};

/// Tells of a file that can't be written.
struct OutputError : std::runtime_error {
  using std::runtime_error::runtime_error;
};

}  // namespace kios::inspect
