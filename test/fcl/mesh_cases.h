// SPDX-FileCopyrightText: 2026 The fcl_kios authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <algorithm>
#include <array>
#include <cstdint>
#include <limits>
#include <memory>
#include <set>
#include <utility>
#include <vector>

#include <fcl/narrowphase/detail/traversal/collision/intersect.h>

#include "all_pairs.h"
#include "fcl_kios/fcl_kios.h"
#include "scenes/motions.h"
#include "scenes/oracle.h"
#include "scenes/shapes.h"

// Mesh pairs and brute-force answers that the tests of FCL's queries share.

namespace kios::testing {

using fcl::Transform3d;
using fcl::Vector3d;
using scenes::Frame;
using scenes::Mesh;
using Pairs = scenes::MeshOracle::Pairs;

inline constexpr std::size_t kAllContacts = std::numeric_limits<std::size_t>::max();

/// Holds two meshes, each to be posed at random within [-spread, spread]^3, so that some poses
/// touch.
struct MeshCase {
  const char* name;
  Mesh a, b;
  double spread;
};

/// Returns meshes in general position with edges of at least 1e-2.
inline std::vector<MeshCase> meshCases() {
  using namespace scenes;
  const Mesh triangle = singleTriangle({0.3, 0.1, -0.2}, {-0.4, 0.7, 0.1}, {0.2, -0.5, 0.6});
  const Mesh other = singleTriangle({-0.9, 0.1, 0.3}, {0.8, 0.2, -0.1}, {0.1, 0.6, 0.2});
  return {{"closed", bumpyTorus(200), bumpyTorus(140), 1.2},
          {"open", sheet(2, 1.5, 7, 6, 0.3), sheet(1.3, 1, 5, 4, 0.2), 0.8},
          {"soup", randomSoup(90, 1, 1e-2, 1, 3), randomSoup(70, 1, 1e-2, 1.5, 4), 1.5},
          {"closed and soup", icosphere(0.7, 1), randomSoup(60, 1, 1e-2, 1, 5), 1.2},
          {"one triangle", triangle, bumpyTorus(100), 0.8},
          {"two triangles", triangle, other, 0.5},
          {"nested", icosphere(0.4, 1), icosphere(1.5, 2), 0.5}};
}

/// Both objects posed at random; `offset` moves the two of them together.
inline std::vector<Frame> randomFrames(int count, double spread, std::uint64_t seed,
                                       const Vector3d& offset = Vector3d::Zero()) {
  std::vector<Transform3d> poses = scenes::randomPoses(2 * count, spread, seed);
  std::vector<Frame> frames;
  for (int i = 0; i < count; ++i) {
    frames.push_back({poses[2 * i], poses[2 * i + 1]});
    frames.back().X_WA.translation() += offset;
    frames.back().X_WB.translation() += offset;
  }
  return frames;
}

/// Returns the larger extent of the two, by which errors are measured.
inline double sizeOf(const Mesh& a, const Mesh& b) { return std::max(extent(a), extent(b)); }

inline std::shared_ptr<Modeld> kiosModel(const Mesh& mesh) {
  return scenes::buildModel<kIOSd>(mesh);
}

/// A model that shares neither volumes nor prepared trees with one of the mesh: a vertex more,
/// which no triangle has, makes its content another.
inline std::shared_ptr<Modeld> modelAlone(Mesh mesh) {
  mesh.vertices.push_back(mesh.vertices.at(0));
  return kiosModel(mesh);
}

inline std::array<Vector3d, 3> corners(const Mesh& mesh, std::intptr_t triangle) {
  const fcl::Triangle& t = mesh.triangles.at(static_cast<std::size_t>(triangle));
  return {mesh.vertices[t[0]], mesh.vertices[t[1]], mesh.vertices[t[2]]};
}

/// Returns the distance of p to the triangle, both in the world frame.
inline double distanceToTriangle(const Vector3d& p, const Transform3d& X_WT, const Mesh& mesh,
                                 std::intptr_t triangle) {
  const scenes::ExactPoint point = p.cast<long double>();
  scenes::ExactTriangle placed;
  const auto c = corners(mesh, triangle);
  for (int i = 0; i < 3; ++i) {
    placed[i] = X_WT.linear().cast<long double>() * c[i].cast<long double>() +
                X_WT.translation().cast<long double>();
  }
  return static_cast<double>(scenes::triangleDistance(placed, {point, point, point}));
}

/// Returns the triangle pairs that contacts name, ascending, each once.
template <typename S>
Pairs contactPairs(const fcl::CollisionResult<S>& result) {
  std::set<std::pair<int, int>> pairs;
  for (std::size_t i = 0; i < result.numContacts(); ++i) {
    const fcl::Contact<S>& contact = result.getContact(i);
    pairs.emplace(static_cast<int>(contact.b1), static_cast<int>(contact.b2));
  }
  return {pairs.begin(), pairs.end()};
}

/// Returns the library's triangle kernels over all pairs of triangles, without a tree.
inline AllPairs allPairs(const Mesh& a, const Mesh& b, const Frame& frame) {
  return {trianglesOf(MeshIn<double>(a)), trianglesOf(MeshIn<double>(b)),
          RelativePose<double>(frame.X_WA, frame.X_WB)};
}
inline double leafDistance(const Mesh& a, const Mesh& b, const Frame& frame) {
  return allPairs(a, b, frame).distance;
}
inline Pairs leafPairs(const Mesh& a, const Mesh& b, const Frame& frame) {
  return allPairs(a, b, frame).hits;
}

/// Holds the answer of FCL's triangle routine for a pair that meets, in A's frame.
struct FclContact {
  std::array<Vector3d, 3> points;  ///< FCL's routine writes up to 3
  unsigned int num_points = 0;
  Vector3d normal = Vector3d::Zero();
  double depth = 0;
};

inline bool fclContact(const Mesh& a, int i, const Mesh& b, int j, const RelativePose<double>& X_AB,
                       FclContact& contact) {
  const auto p = corners(a, i), q = corners(b, j);
  return fcl::detail::Intersect<double>::intersect_Triangle(
      p[0], p[1], p[2], X_AB * q[0], X_AB * q[1], X_AB * q[2], contact.points.data(),
      &contact.num_points, &contact.depth, &contact.normal);
}

}  // namespace kios::testing
