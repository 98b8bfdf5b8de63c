// SPDX-FileCopyrightText: 2026 The fcl_kios authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <memory>
#include <string>
#include <vector>

#include "paper/all_fits.h"
#include "paper/kios_policy.h"
#include "paper/mesh_split.h"
#include "paper/spheres_policy.h"
#include "scenes/mesh.h"
#include "volume/exact_spheres.h"

namespace kios::testing {

using namespace paper;

using Split = std::shared_ptr<const MeshSplit>;

inline Split splitOf(const scenes::Mesh& mesh) { return std::make_shared<const MeshSplit>(mesh); }

/// Calls visit(name, policy) for kIOS with all fits and for the other kinds.
template <typename Visit>
void forEachKind(Visit visit) {
  for (const auto count : {SphereCount::kByRatio, SphereCount::kAll, SphereCount::kByGain}) {
    for (const bool shared : {false, true}) {
      FitOptions options;
      options.count = count;
      options.shared_radius = shared;
      const std::string name = nameOf(options);
      visit("oriented 1, " + name, OrientedKios<1>(options));
      visit("oriented 3, " + name, OrientedKios<3>(options));
      visit("oriented 5, " + name, OrientedKios<5>(options));
      visit("oriented 7, " + name, OrientedKios<7>(options));
      visit("axis-aligned, " + name, AxisAlignedKios(options));
      visit("fixed directions, " + name, FixedDirectionKios(options));
      // As the faces of an octahedron, not of unit length.
      const std::vector<fcl::Vector3d> given = {{1, 1, 1}, {1, 1, -1}, {1, -1, 1}, {-3, 3, 3}};
      visit("given directions, " + name, FixedDirectionKios(given, options));
      options.method = FitMethod::kMethodI;
      visit("oriented 5, " + nameOf(options), OrientedKios<5>(options));
      options.method = FitMethod::kMethodIAtAngle;
      visit("oriented 5, " + nameOf(options), OrientedKios<5>(options));
      options.method = FitMethod::kMethodII;
      visit("oriented 5, " + nameOf(options), OrientedKios<5>(options));
    }
  }
}

template <typename Visit>
void forEachPolicy(Visit visit) {
  for (const FitOptions& options : allFits())
    visit("kIOS, " + nameOf(options), KiosPolicy(options));
  forEachKind(visit);
}

}  // namespace kios::testing
