// SPDX-FileCopyrightText: 2026 The fcl_kios authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "all_pairs.h"
#include "query/query_cases.h"

// Bodies of few triangles, nasty ones among them, and poses at which they are near.

namespace kios::testing {

using scenes::Random;

inline Mesh box(const fcl::Vector3d& size) { return scenes::subdividedBox(size, 1); }

/// Returns soups with needles, segments, points and repeated triangles among their triangles.
inline Mesh nastySoup(int count, Random& random) {
  Mesh mesh =
      scenes::randomSoup(count, 0.5, 0.05, 1.5, static_cast<std::uint64_t>(random.uniform(0, 1e9)));
  for (std::size_t t = 0; t < mesh.triangles.size(); ++t) {
    const double kind = random.uniform(0, 1);
    fcl::Vector3d* const v = &mesh.vertices[3 * t];
    if (kind < 0.1) v[2] = v[1];
    if (kind < 0.03) v[1] = v[2] = v[0];
    if (kind > 0.9) v[2] = (v[0] + v[1]) / 2;
    if (kind > 0.8 && t > 0) std::copy_n(&mesh.vertices[3 * t - 3], 2, v);
  }
  return mesh;
}

/// Returns corners on a coarse grid, so that faces, edges and vertices meet exactly.
inline Mesh gridSoup(int count, Random& random) {
  Mesh mesh;
  for (int i = 0; i < 3 * count; ++i) {
    fcl::Vector3d p;
    for (int c = 0; c < 3; ++c) p[c] = 0.25 * std::floor(random.uniform(0, 5));
    mesh.vertices.push_back(p);
  }
  for (int i = 0; i < count; ++i) mesh.triangles.emplace_back(3 * i, 3 * i + 1, 3 * i + 2);
  return mesh;
}

inline Mesh smallMesh(int kind, Random& random) {
  const auto size = [&] { return random.uniform(0.1, 1); };
  switch (kind % 8) {
    case 0:
      return box({size(), size(), size()});
    case 1:
      return nastySoup(1 + static_cast<int>(random.uniform(0, 32)), random);
    case 2:
      return gridSoup(1 + static_cast<int>(random.uniform(0, 20)), random);
    case 3:
      return scenes::icosphere(size(), static_cast<int>(random.uniform(0, 2)));
    case 4:
      return box({1, 0.5, 0.25});
    case 5:
      return nastySoup(1, random);
    case 6:
      return scenes::sheet(1, 1, 3, 4, 0);
    default:
      return scenes::uvSphere(size(), 6, 10);
  }
}

/// Returns poses in general position, on a grid (faces and edges parallel, or in one plane), and so
/// that the bodies nearly touch; the two together far from the origin, or not.
template <typename S>
Poses<S> poseAt(int kind, double apart, Random& random) {
  const auto seed = static_cast<std::uint64_t>(random.uniform(0, 1e9));
  auto poses = scenes::randomPoses(2, 1, seed);
  if (kind % 3 == 0) {
    for (auto& X : poses) {
      X.linear().setIdentity();
      for (int c = 0; c < 3; ++c) X.translation()[c] = 0.25 * std::floor(random.uniform(-4, 5));
    }
  } else {
    poses[1].translation() = poses[0].translation() + apart * poses[1].translation().normalized();
  }
  if (kind % 5 == 0) {
    const double far = sizeof(S) == sizeof(double) ? 0x1p30 : 0x1p10;
    for (auto& X : poses) X.translation() += fcl::Vector3d(far, -far, far / 2);
  }
  return {poses[0].cast<S>(), poses[1].cast<S>()};
}

template <typename S>
AllPairs allPairs(const Model<S>& a, const Model<S>& b, const Poses<S>& X) {
  return {trianglesOf(a), trianglesOf(b), RelativePosed(X.X_WA, X.X_WB)};
}

}  // namespace kios::testing
