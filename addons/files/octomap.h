// SPDX-FileCopyrightText: 2026 The fcl_kios authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <memory>
#include <string>
#include <string_view>

#include <fcl/geometry/collision_geometry.h>

namespace kios::files {

/// Makes an octree of octomap's nodes, written with bits alone or with their log-odds, and of the
/// length of a cell. Throws std::invalid_argument where the data end early, go on after the last
/// node, have more levels than the 16 of octomap, or a value that isn't finite.
std::shared_ptr<fcl::CollisionGeometryd> octreeOf(std::string_view nodes, bool with_values,
                                                  double resolution);

/// Reads an octree from a file of octomap's, .bt or .ot, of the kind OcTree. Throws as contentOf()
/// and octreeOf().
std::shared_ptr<fcl::CollisionGeometryd> readOctomap(const std::string& file);

}  // namespace kios::files
