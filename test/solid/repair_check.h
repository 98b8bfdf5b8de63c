// SPDX-FileCopyrightText: 2026 The fcl_kios authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <utility>
#include <vector>

#include "fcl_kios/repair.h"
#include "solid/solid_meshes.h"

// Checks of what repair() says of its work.

namespace kios::testing {

using Vector3d = fcl::Vector3d;

inline RepairResultd repaired(const Mesh& mesh, const RepairRequest& options = {}) {
  return repair(mesh.vertices, mesh.triangles, options);
}

inline RepairRequest filling(int edges) {
  RepairRequest options;
  options.max_hole_edges = edges;
  return options;
}

/// Returns six times the signed volume.
inline double volumeOf(const std::vector<Vector3d>& v,
                       const std::vector<fcl::Triangle>& triangles) {
  double sum = 0;
  for (const fcl::Triangle& t : triangles) sum += v[t[0]].dot(v[t[1]].cross(v[t[2]]));
  return sum;
}

/// Says what is reported is what was done.
inline void expectHonest(const Mesh& mesh, const RepairResultd& r) {
  ASSERT_EQ(r.vertex_of.size(), mesh.vertices.size());
  ASSERT_EQ(r.triangle_of.size(), r.triangles.size());
  std::vector<bool> used(mesh.vertices.size(), false);
  for (const fcl::Triangle& t : mesh.triangles) used[t[0]] = used[t[1]] = used[t[2]] = true;
  double farthest = 0;
  int moved = 0;
  for (std::size_t v = 0; v < used.size(); ++v) {
    if (r.vertex_of[v] < 0) continue;
    ASSERT_TRUE(used[v]);
    const Vector3d& to = r.vertices.at(static_cast<std::size_t>(r.vertex_of[v]));
    const double way = (to - mesh.vertices[v]).norm();
    EXPECT_LE(way, r.weld * (1 + 1e-12));
    farthest = std::max(farthest, way);
    moved += to != mesh.vertices[v] ? 1 : 0;
  }
  EXPECT_NEAR(farthest, r.farthest_weld, 1e-15 + 1e-12 * farthest);
  EXPECT_EQ(moved, r.moved_vertices);
  EXPECT_EQ(r.farthest_vertex >= 0, moved > 0);
  int flipped = 0, added = 0;
  for (std::size_t i = 0; i < r.triangles.size(); ++i) {
    const fcl::Triangle& now = r.triangles[i];
    if (r.triangle_of[i] < 0) {
      ++added;
      continue;
    }
    const fcl::Triangle& given = mesh.triangles[static_cast<std::size_t>(r.triangle_of[i])];
    std::array<int, 3> was{};
    for (int k = 0; k < 3; ++k) was[static_cast<std::size_t>(k)] = r.vertex_of[given[k]];
    const auto is = [&](int a, int b, int c) {
      return static_cast<int>(now[0]) == was[static_cast<std::size_t>(a)] &&
             static_cast<int>(now[1]) == was[static_cast<std::size_t>(b)] &&
             static_cast<int>(now[2]) == was[static_cast<std::size_t>(c)];
    };
    const bool same = is(0, 1, 2) || is(1, 2, 0) || is(2, 0, 1);
    EXPECT_TRUE(same || is(0, 2, 1) || is(2, 1, 0) || is(1, 0, 2));
    flipped += same ? 0 : 1;
  }
  EXPECT_EQ(flipped, r.flipped_triangles);
  EXPECT_EQ(added, r.filled_triangles);
  EXPECT_EQ(mesh.triangles.size() + static_cast<std::size_t>(added),
            r.triangles.size() + static_cast<std::size_t>(r.degenerate_triangles) +
                static_cast<std::size_t>(r.double_triangles));
  EXPECT_EQ(r.closedness.isSolid(), inspectClosedness(r.vertices, r.triangles).isSolid());
  // Each edge that is left open is at one of the holes, where all that is at edges of one face.
  std::size_t edges = 0;
  for (const Hole& hole : r.open) {
    edges += hole.vertices.size();
    double around = 0;
    for (std::size_t i = 0; i < hole.vertices.size(); ++i) {
      const auto at = [&](std::size_t j) {
        return r.vertices.at(static_cast<std::size_t>(hole.vertices[j % hole.vertices.size()]));
      };
      around += (at(i + 1) - at(i)).norm();
    }
    EXPECT_NEAR(around, hole.perimeter, 1e-12 * around);
  }
  EXPECT_LE(edges, static_cast<std::size_t>(r.closedness.open_edges));
}

}  // namespace kios::testing
