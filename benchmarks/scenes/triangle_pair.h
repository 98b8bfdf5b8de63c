// SPDX-FileCopyrightText: 2026 The fcl_kios authors
// SPDX-License-Identifier: BSD-3-Clause

#pragma once

#include <array>

#include <Eigen/Core>

namespace kios::scenes {

/// Holds two triangles in one frame.
struct TrianglePair {
  std::array<Eigen::Vector3d, 3> a, b;
};

/// Returns L, the diagonal of the pair's bounding box, by which errors are measured.
long double extent(const TrianglePair& pair);

/// Returns the largest magnitude of a coordinate of the pair.
double magnitude(const TrianglePair& pair);

}  // namespace kios::scenes
