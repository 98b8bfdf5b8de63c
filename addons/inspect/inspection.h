// SPDX-FileCopyrightText: 2026 The fcl_kios authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <array>
#include <filesystem>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "defects.h"
#include "fcl_kios/repair.h"
#include "inspect/output.h"
#include "progress.h"
#include "tightness.h"
#include "volume_tree.h"

namespace kios::inspect {

/// More pairs of triangles that meet aren't listed.
constexpr std::size_t kMostSelfIntersections = 1000000;

/// Holds a mesh, its model and its tree, and what there is to tell about them.
struct Inspection {
  std::string file;
  Mesh mesh;  ///< repaired, if that was asked for
  std::optional<RepairResultd> repaired;
  Defects defects;
  std::vector<SelfIntersection> self_intersections;  ///< up to kMostSelfIntersections
  std::shared_ptr<Modeld> model;
  std::unique_ptr<VolumeTree> tree;
  Eigen::AlignedBox3d box;            ///< around the triangles
  std::array<std::size_t, 3> k = {};  ///< nodes of 1, 3 and 5 spheres
  std::size_t model_bytes = 0;        ///< vertices, indices and tree of volumes
  std::size_t prepared_bytes = 0;     ///< of the tree that queries search
  std::vector<LevelTightness> levels;
  double read_seconds = 0, build_seconds = 0;

  int nodes() const { return model->getNumBVs(); }
  /// Returns how many of the pairs meet like that.
  std::size_t count(Meeting kind) const;
  /// Returns warnings() of the mesh, and one of triangles that meet.
  std::vector<std::string> warnings() const;
};

/// Reads and examines a file. Throws InputError with what readMesh() says, and where a mesh is
/// beyond the library's range. `tightness`: measure the levels. With `repair` it is the repaired
/// mesh that is examined.
Inspection inspect(const std::filesystem::path& file, bool tightness, Progress& progress,
                   const RepairRequest* repair = nullptr);

}  // namespace kios::inspect
