// SPDX-FileCopyrightText: 2026 The fcl_kios authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <string>
#include <vector>

#include "fcl_kios/solids.h"
#include "files/read_mesh.h"

namespace kios::inspect {

using files::Mesh;

/// A triangle whose height over its longest edge is below this part of that edge is a sliver.
constexpr double kSliverHeight = 1e-3;

/// Holds the oddities of a mesh. Queries answer exactly in spite of all; they cost time, or show
/// that an exporter went wrong. Corners count as the same if their coordinates are equal.
struct Defects {
  std::size_t distinct_vertices = 0;  ///< by coordinates, of those that a triangle uses
  std::size_t unreferenced = 0;       ///< vertices that no triangle uses
  std::size_t zero_area = 0;          ///< corners that coincide, or lie on a line to rounding
  std::size_t slivers = 0;            ///< thinner than kSliverHeight, but of some area
  std::size_t duplicates = 0;         ///< triangles with the corners of an earlier one
  std::size_t first_zero_area = 0;    ///< a triangle of each kind, if there is one
  std::size_t first_sliver = 0;
  std::size_t first_duplicate = 0;
  Closedness surface;  ///< whether and why it can't be a solid
};

Defects findDefects(const Mesh& mesh);

/// Returns a sentence for each thing that a user may want to repair; none for a clean mesh. An open
/// mesh is no defect and has no sentence.
std::vector<std::string> warnings(const Mesh& mesh, const Defects& defects);

}  // namespace kios::inspect
