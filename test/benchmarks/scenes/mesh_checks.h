// SPDX-FileCopyrightText: 2026 The fcl_kios authors
// SPDX-License-Identifier: BSD-3-Clause

#pragma once

#include <gtest/gtest.h>

#include <cmath>
#include <map>
#include <utility>

#include "scenes/mesh.h"

// Checks that several tests of shapes make.

namespace kios::scenes {

inline const double kPi = std::acos(-1.0);

inline double signedVolume(const Mesh& mesh) {
  double six_volumes = 0;
  for (const fcl::Triangle& t : mesh.triangles) {
    six_volumes += mesh.vertices[t[0]].dot(mesh.vertices[t[1]].cross(mesh.vertices[t[2]]));
  }
  return six_volumes / 6;
}

/// Closed and consistently wound outward: every directed edge has its opposite exactly once.
inline void expectClosed(const Mesh& mesh) {
  std::map<std::pair<std::size_t, std::size_t>, int> directed_edges;
  for (const fcl::Triangle& t : mesh.triangles) {
    for (int i = 0; i < 3; ++i) ++directed_edges[{t[i], t[(i + 1) % 3]}];
  }
  for (const auto& [edge, count] : directed_edges) {
    EXPECT_EQ(count, 1);
    EXPECT_EQ(directed_edges.count({edge.second, edge.first}), 1u);
  }
  EXPECT_GT(signedVolume(mesh), 0);
}

}  // namespace kios::scenes
