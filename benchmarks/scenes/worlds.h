// SPDX-FileCopyrightText: 2026 The fcl_kios authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <limits>
#include <string>
#include <vector>

#include <fcl/common/types.h>

#include "mesh.h"

// What stands about a robot: few large triangles, or large ones among small ones. Metres; z is up.

namespace kios::scenes {

/// Holds a box of a world, centred on its own frame.
struct Board {
  fcl::Vector3d size;
  fcl::Transform3d X_WB;
};

struct World {
  std::string name;
  Mesh mesh;                  ///< in the world frame
  std::vector<Board> boards;  ///< whose surfaces are the mesh; none where it isn't made of boxes
  /// Robots work at surfaces within this box.
  fcl::Vector3d lower = fcl::Vector3d::Constant(-std::numeric_limits<double>::infinity());
  fcl::Vector3d upper = fcl::Vector3d::Constant(std::numeric_limits<double>::infinity());
};

/// Returns the surfaces of boxes, 12 triangles each.
World boxWorld(const std::string& name, const std::vector<Board>& boards);

/// Made of boxes: table top, table with legs, floor slab, room, shelf, open crate, bins, stairs.
std::vector<World> boxWorlds();

/// Made of triangles: terrain of 1 m, of 10 m and of 5 cm, a building of `building` triangles or a
/// few thousand more, needles, and a pole of strips.
std::vector<World> meshWorlds(int building);

/// Is the number of gaps that posesNear() takes in turn.
inline constexpr std::size_t kGapsOfPoses = 7;

/// Returns poses of a link in the world frame, in turn pushed into the world by up to 3 cm, at a
/// gap of 0.2 to 5 mm, again in contact, again at such a gap, and at 5 to 50 mm, 5 to 50 cm, and
/// 0.5 to 3 m: the gap of the link, turned at random, to the plane of a triangle at a random point
/// of it. Half of the triangles are drawn by area. Other parts of the world may be nearer, but the
/// oracle finds contact where it is meant to be, and nowhere else, unless thirty attempts fail.
std::vector<fcl::Transform3d> posesNear(const World& world, const Mesh& link, int count,
                                        std::uint64_t seed);

/// Returns points of a depth camera's view of a table before a wall, about `spacing` apart, each
/// off its surface by up to `noise`.
std::vector<fcl::Vector3d> scannedTable(double spacing, double noise, std::uint64_t seed);

}  // namespace kios::scenes
