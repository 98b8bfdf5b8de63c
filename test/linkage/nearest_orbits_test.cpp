// SPDX-FileCopyrightText: 2026 The fcl_kios authors
// SPDX-License-Identifier: BSD-3-Clause
//
// The first look at a proof by turns: the orbits of two triangles refute only what all triangles
// do.

#include "linkage/orbits.h"
#include "linkage/tight_fits.h"

namespace kios::testing {
namespace {

using articulated::Configuration;
using articulated::Pair;
using articulated::Path;

struct Verdicts {
  bool all;           ///< of orbitsApart()
  bool unknown;       ///< of nearestOrbitsApart() before a query
  long refuted = 0;   ///< pairs of triangles that it refutes
  long compared = 0;  ///< all pairs of triangles, or of a shape and a triangle
};

int numTriangles(const BodyGeometry& body) {
  const auto* const model = dynamic_cast<const Modeld*>(body.get());
  return model ? model->num_tris : 1;
}

Verdicts judge(const BodyGeometry& body, const BodyGeometry& around,
               const std::vector<Vector3d>& axes, double separation) {
  const RobotCase robot = fitted(body, around, JointType::kRevolute, axes, true);
  const auto n = static_cast<Eigen::Index>(axes.size());
  const Joints q0 = Joints::Zero(n), q1 = Joints::Constant(n, 2);
  const Path path(robot.linkage.impl(), q0, q1);
  const Configuration at(path, 0.5);
  Pair pair{0, 1, 0};
  Verdicts verdicts;
  verdicts.unknown = nearestOrbitsApart(path, pair, at, separation);
  long long cost = 0;
  verdicts.all = orbitsApart(path, pair, at, separation, cost);
  for (int i = 0; i < numTriangles(body); ++i) {
    for (int k = 0; k < numTriangles(around); ++k) {
      pair.triangle_a = i;
      pair.triangle_b = k;
      ++verdicts.compared;
      verdicts.refuted += nearestOrbitsApart(path, pair, at, separation) ? 0 : 1;
    }
  }
  return verdicts;
}

TEST(NearestOrbits, RefuteWhatAllTrianglesDo) {
  const double clearance = 1e-3;
  const std::vector<Vector3d> line = {{0, 0, 1}}, point = {{0, 0, 1}, {1, 0, 0}};
  const BodyGeometry hole = modelOf(ring(0.01 + clearance, 0.03, 0.1, 12)),
                     shaft = modelOf(rod(0.01, 0.2, 12, 0.37)),
                     cylinder = std::make_shared<fcl::Cylinderd>(0.01, 0.2),
                     socket = modelOf(bowl((0.02 + clearance) / 0.98, 0.35 * kPi, 16, 6)),
                     ball = modelOf(bowl(0.02, 0, 16, 8)),
                     sphere = std::make_shared<fcl::Sphered>(0.02);
  struct Case {
    BodyGeometry body, around;
    std::vector<Vector3d> axes;
  };
  for (const Case& fit :
       {Case{shaft, hole, line}, Case{hole, shaft, line}, Case{cylinder, hole, line},
        Case{hole, cylinder, line}, Case{ball, socket, point}, Case{sphere, socket, point}}) {
    const Verdicts apart = judge(fit.body, fit.around, fit.axes, 0.5 * clearance);
    EXPECT_TRUE(apart.all);
    EXPECT_TRUE(apart.unknown);
    EXPECT_EQ(apart.refuted, 0);
    EXPECT_GE(apart.compared, 48);
    // A separation that the clearance doesn't leave is refuted, by some triangles and not by
    // others.
    const Verdicts near = judge(fit.body, fit.around, fit.axes, 2 * clearance);
    EXPECT_FALSE(near.all);
    EXPECT_TRUE(near.unknown);
    EXPECT_GT(near.refuted, 0);
    EXPECT_EQ(near.refuted == near.compared, fit.axes.size() > 1);
  }
}

}  // namespace
}  // namespace kios::testing
