// SPDX-FileCopyrightText: 2026 The fcl_kios authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "mesh.h"

namespace kios::scenes {

/// The mesh with a vertex more, that no triangle has and that lies between two others: its content
/// differs from that of all meshes before, and models of it share nothing with theirs.
inline Mesh unlike(Mesh mesh) {
  static int count = 0;
  ++count;
  const fcl::Vector3d from = mesh.vertices.at(0), to = mesh.vertices.at(1);
  mesh.vertices.push_back(from + count % 65521 / 65521.0 * (to - from));
  return mesh;
}

}  // namespace kios::scenes
