// SPDX-FileCopyrightText: 2026 The fcl_kios authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <vector>

#include "mesh.h"

// Parts of machines, triangulated as CAD kernels do it: flat faces as fans and as few triangles as
// their corners allow, long strips along fillets and threads, aspects up to 1000. All are closed,
// share vertices and are wound counter-clockwise seen from outside.

namespace kios::scenes {

/// Returns a pipe about z from z = 0 to `length`, of 8 segments triangles.
Mesh tube(double inner_radius, double outer_radius, double length, int segments);

/// Returns a spur gear about z from z = 0 to `thickness` with straight-sided teeth, whose height is
/// 2.25 `module`, the pitch circle's diameter being teeth * module, and a round bore of `segments`
/// edges.
Mesh spurGear(int teeth, double module, double thickness, double bore_radius, int segments);

/// Returns a plate [0, columns * pitch] x [0, rows * pitch] x [0, thickness] with a round hole of
/// `segments` edges, a multiple of 4, in each of its squares, top and bottom as fans between square
/// and hole.
Mesh drilledPlate(int columns, int rows, double pitch, double hole_radius, double thickness,
                  int segments);

/// Screw along z with a hexagonal head below z = 0 and a thread of `turns` turns above it, `radius`
/// outside and 0.15 radius deep, each turn of `segments` steps.
Mesh screw(double radius, double pitch, int turns, int segments);

/// Returns one of each, between 0.05 and 0.3 large: 800 to 6,000 triangles.
std::vector<Mesh> cadParts();

}  // namespace kios::scenes
