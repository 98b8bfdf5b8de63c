// SPDX-FileCopyrightText: 2026 The fcl_kios authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <gtest/gtest.h>

#include <cmath>
#include <vector>

#include "fcl/mesh_cases.h"

namespace kios::testing {

/// The mesh swayed: every vertex moves, triangles stay triangles.
inline std::vector<Vector3d> swayed(const Mesh& mesh, double phase) {
  std::vector<Vector3d> vertices = mesh.vertices;
  for (Vector3d& p : vertices) {
    p += 0.2 *
         Vector3d(std::sin(3 * p[1] + phase), std::cos(2 * p[2] + phase), std::sin(p[0] - phase));
  }
  return vertices;
}

inline void replace(Modeld& model, const std::vector<Vector3d>& vertices, bool refit,
                    bool bottomup) {
  ASSERT_EQ(model.beginReplaceModel(), fcl::BVH_OK);
  ASSERT_EQ(model.replaceSubModel(vertices), fcl::BVH_OK);
  ASSERT_EQ(model.endReplaceModel(refit, bottomup), fcl::BVH_OK);
}

inline void update(Modeld& model, const std::vector<Vector3d>& vertices, bool refit,
                   bool bottomup) {
  ASSERT_EQ(model.beginUpdateModel(), fcl::BVH_OK);
  ASSERT_EQ(model.updateSubModel(vertices), fcl::BVH_OK);
  ASSERT_EQ(model.endUpdateModel(refit, bottomup), fcl::BVH_OK);
}

}  // namespace kios::testing
