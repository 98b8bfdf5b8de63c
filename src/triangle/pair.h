// SPDX-FileCopyrightText: 2026 The fcl_kios authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <Eigen/Core>

namespace kios {

inline constexpr double kEps = 0x1p-52;

/// Two triangles in canonical order, relative to a common origin near them: what both distance
/// kernels work on. p: the first, q: the second.
struct TrianglePair {
  Eigen::Vector3d p[3], q[3];
  double magnitude;  ///< largest |coordinate|
};

/// Part of one of a pair's triangles: vertex i, edge i (from vertex i to the next), or the face.
struct PairFeature {
  enum Kind { kVertex, kEdge, kFace } kind;
  int index;
};

/// Nearest points of a pair and where they lie.
struct PairDistance {
  double distance;
  Eigen::Vector3d on_p, on_q;
  PairFeature feature_p, feature_q;
};

constexpr int nextVertex(int i) { return i == 2 ? 0 : i + 1; }

/// The distance of a disjoint pair: the least over all pairs of features, each evaluated so that
/// its error is a few eps magnitude for any shape. The magnitude must lie within 2^+-32.
PairDistance robustDistance(const TrianglePair& pair);

}  // namespace kios
