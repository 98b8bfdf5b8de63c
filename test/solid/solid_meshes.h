// SPDX-FileCopyrightText: 2026 The fcl_kios authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <array>
#include <cstdlib>
#include <memory>
#include <vector>

#include "fcl_kios/fcl_kios.h"
#include "shapes.h"

// Closed meshes that the tests of solids share.

namespace kios::testing {

inline const fcl::Transform3d kHere = fcl::Transform3d::Identity();

/// From the environment, for longer runs by hand.
inline int casesOr(int usual) {
  const char* const value = std::getenv("KIOS_SOLID_CASES");
  return value ? std::atoi(value) : usual;
}

inline Mesh flipped(Mesh mesh) {
  for (fcl::Triangle& t : mesh.triangles) t.set(t[0], t[2], t[1]);
  return mesh;
}

/// Returns a shell about the origin: a ball with a concentric cavity.
inline Mesh shell(double outer, double inner, int subdivisions) {
  return scenes::merged(
      {scenes::icosphere(outer, subdivisions), flipped(scenes::icosphere(inner, subdivisions))});
}

template <typename S = double>
std::shared_ptr<Model<S>> modelOf(const Mesh& mesh) {
  return scenes::buildModel<kIOS<S>>(mesh);
}

template <typename S = double>
std::shared_ptr<Model<S>> solidOf(const Mesh& mesh) {
  auto model = modelOf<S>(mesh);
  markSolid(*model);
  return model;
}

template <typename S = double>
fcl::Transform3<S> at(double x, double y, double z) {
  fcl::Transform3<S> X = fcl::Transform3<S>::Identity();
  X.translation() = fcl::Vector3d(x, y, z).template cast<S>();
  return X;
}

/// Returns a prism along y over a polygon, counterclockwise in (x, z), and its triangles: without
/// any, those that fan out of its first corner.
inline Mesh prism(const std::vector<std::array<double, 2>>& contour,
                  std::vector<std::array<std::size_t, 3>> triangles,
                  const std::vector<double>& levels) {
  Mesh mesh;
  const std::size_t n = contour.size(), top = (levels.size() - 1) * n;
  for (std::size_t i = 1; triangles.size() + 2 < n && i + 1 < n; ++i) {
    triangles.push_back({0, i, i + 1});
  }
  for (const double y : levels) {
    for (const auto& p : contour) mesh.vertices.emplace_back(p[0], y, p[1]);
  }
  for (const auto& t : triangles) {
    mesh.triangles.emplace_back(t[0], t[1], t[2]);
    mesh.triangles.emplace_back(top + t[0], top + t[2], top + t[1]);
  }
  for (std::size_t low = 0; low < top; low += n) {
    for (std::size_t i = 0; i < n; ++i) {
      const std::size_t p = low + i, q = low + (i + 1) % n;
      mesh.triangles.emplace_back(p + n, q + n, q);
      mesh.triangles.emplace_back(p + n, q, p);
    }
  }
  return mesh;
}

/// Returns solids, convex and not, in one piece and in several, of extent about 1 to 5.
inline std::vector<NamedMesh> solidMeshes() {
  using namespace scenes;
  return {{"box", subdividedBox({1, 2, 3}, 2)},
          {"ball", icosphere(1, 2)},
          {"soup of a torus", soup(bumpyTorus(300))},
          {"blob", bumpyBlob()},
          {"slivers", uvSphere(1, 6, 40)},
          {"nested shells", merged({shell(2, 1.5, 2), shell(1, 0.5, 1), icosphere(0.25, 1)})},
          {"overlapping parts",
           merged({subdividedBox({1, 2, 3}, 1), subdividedBox({3, 1, 1}, 1), icosphere(0.2, 1)})},
          {"separate parts", merged({transformed(icosphere(1, 1), 1, {3, 0, 0}),
                                     transformed(bumpyTorus(200), 1, {-2, 0, 0})})},
          {"boxes that share an edge",
           merged({subdividedBox({1, 1, 1}, 1),
                   transformed(subdividedBox({1, 1, 1}, 1), 1, {1, 1, 0})})}};
}

}  // namespace kios::testing
