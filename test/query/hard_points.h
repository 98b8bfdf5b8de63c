// SPDX-FileCopyrightText: 2026 The fcl_kios authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <algorithm>
#include <cstdint>

#include "scenes/triangle_families.h"
#include "shapes.h"

namespace kios::testing {

/// Returns points where distances and sides are hard: in turn on a mesh's corners, edges and faces,
/// all but on them, level with a corner, at the same distance from many parts, anywhere about it
/// and far away. `size` and `offset` are those of the mesh.
inline Eigen::Matrix3Xd pointsAbout(const Mesh& mesh, int count, double size,
                                    const fcl::Vector3d& offset, std::uint64_t seed) {
  Random random(seed);
  Eigen::Matrix3Xd points(3, count);
  for (int i = 0; i < count; ++i) {
    const auto& t = mesh.triangles[static_cast<std::size_t>(
        scenes::integer(random, 0, static_cast<int>(mesh.triangles.size()) - 1))];
    const fcl::Vector3d &a = mesh.vertices[t[0]], &b = mesh.vertices[t[1]],
                        &c = mesh.vertices[t[2]], step = size * inCube(random);
    const double u = random.unit(), v = (1 - u) * random.unit();
    const fcl::Vector3d on_face = a + u * (b - a) + v * (c - a);
    const fcl::Vector3d all[] = {
        a,
        0.5 * (b + c),
        a + u * (b - a),
        on_face,
        on_face + 1e-12 * step,
        (a + b + c) / 3 + 1e-9 * step,
        a,
        a + 1e-12 * step,
        {a[0], b[1], c[2]},
        {a[0], a[1], a[2] + step[2]},
        offset + (i % 24 < 12 ? 0 : size) * scenes::displacement(random, 1, 40),
        offset + 1.5 * step};
    points.col(i) = all[i % 12];
  }
  return points;
}

}  // namespace kios::testing
