// SPDX-FileCopyrightText: 2026 The fcl_kios authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <array>
#include <cstdint>
#include <string>
#include <vector>

#include "inspection.h"

namespace kios::inspect {

using Color = std::array<std::uint8_t, 3>;  ///< sRGB

/// One colour a node: hues go around the circle once, in the order of the content, so that a
/// volume's parts have colours like its own; neighbours differ in lightness. `place`: which of its
/// level's volumes it is.
Color colorOf(const VolumeTree& tree, int node, std::size_t place);

/// Colour of the first and the second mesh.
Color meshColor(int which);

/// What goes into a file for viewers, in the file's frame and units.
struct PaintedMesh {
  std::string name;
  std::vector<std::array<float, 3>> vertices;
  std::vector<std::array<float, 3>> normals;  ///< one a vertex, or none: flat
  std::vector<std::array<std::uint32_t, 3>> triangles;
  Color color = {};
  bool see_through = false;
};

/// The volumes of a level, each a mesh of its own, with normals of the spheres, and those vertices
/// doubled where two spheres meet. 20 * 4^detail triangles each, and some where spheres meet.
/// Volumes of a single point are left out.
std::vector<PaintedMesh> paintLevel(const VolumeTree& tree, int level, int detail);

PaintedMesh paintMesh(const Inspection& inspection);

}  // namespace kios::inspect
