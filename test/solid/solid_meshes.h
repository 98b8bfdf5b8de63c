// SPDX-FileCopyrightText: 2026 The fcl_kios authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdlib>
#include <memory>

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
