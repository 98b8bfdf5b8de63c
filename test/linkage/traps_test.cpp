// SPDX-FileCopyrightText: 2026 The fcl_kios authors
// SPDX-License-Identifier: BSD-3-Clause
//
// Moving objects raise no floating-point flags; mesh_fuzz traps those of linkages.
#include "continuous/moving_meshes.h"
#include "fcl/partners.h"
#include "floating_point_flags.h"

namespace kios::testing {
namespace {

TEST(MotionTraps, MovingObjects) {
  Flags flags;
  const Geometry torus = kiosModel(scenes::bumpyTorus(200));
  for (const auto& [name, other] : partners()) {
    for (const auto type : kMotionTypes) {
      for (int i = 0; i < 6; ++i) {
        const auto poses = scenes::randomPoses(4, i < 3 ? 2.0 : 0.4, 10 * i);
        flags.during(name + ": continuousCollide", [&] {
          fcl::ContinuousCollisionResultd result;
          fcl::continuousCollide(torus.get(), poses[0], poses[1], other.get(), poses[2], poses[3],
                                 requestFor(type, 1e-3), result);
        });
      }
      flags.during(name + ": continuousCollide, still", [&] {
        fcl::ContinuousCollisionResultd result;
        fcl::continuousCollide(torus.get(), at(0, 0, 0), at(0, 0, 0), other.get(), at(3, 0, 0),
                               at(3, 0, 0), requestFor(type, 1e-3), result);
      });
    }
  }
}

}  // namespace
}  // namespace kios::testing
