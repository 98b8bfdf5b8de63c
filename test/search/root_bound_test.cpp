// SPDX-FileCopyrightText: 2026 The fcl_kios authors
// SPDX-License-Identifier: BSD-3-Clause
//
// The bound of two models by the boxes of their roots is at most their distance, measured over all
// pairs of triangles: boxes whose faces, edges and corners meet or all but meet, far from their
// origins for their size too; and it tells boxes that are apart. A ball off the box of a body that
// is thin or much larger is off what is in it, which is told before, and so are bodies that stand a
// hair above it, whose balls reach into it.

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <vector>

#include "fcl_kios/model/prepare.h"
#include "query/smaller_off_box.h"
#include "scalars.h"
#include "scenes/cad_shapes.h"
#include "search/prepared_pair.h"
#include "search/root_bound.h"
#include "volume/rotation.h"

namespace kios::testing {
namespace {

struct Outcome {
  long wrong = 0, without_pad = 0, apart = 0, told = 0, off = 0;
};

template <typename S>
bool isOff(const Model<S>& a, const fcl::Transform3<S>& X_WA, const Model<S>& b,
           const fcl::Transform3<S>& X_WB, double margin) {
  const CentralWay way(a.getBV(0).bv, X_WA, b.getBV(0).bv, X_WB);
  return smallerOffBox(a, X_WA, b, X_WB, way, squaredRotationErrors(X_WA, X_WB), margin);
}

/// Both meshes at poses where they are `gap` apart, or nearly so.
template <typename S>
void tryPoses(const Mesh& a, const Mesh& b, double size, double offset, bool parallel,
              std::uint64_t seed, Outcome& sum) {
  Random random(seed);
  const fcl::Vector3d away = offset * size * inCube(random);
  PosedPair<S> posed(transformed(a, size, away), transformed(b, size, away));
  const auto model_a = makeModel<S>(posed.a.vertices, posed.a.triangles),
             model_b = makeModel<S>(posed.b.vertices, posed.b.triangles);
  prepare(*model_a);
  prepare(*model_b);
  for (const double gap : {0.0, 1e-7, 1e-4, 1e-2, 0.3}) {
    fcl::Transform3d X_AB = fcl::Transform3d::Identity();
    if (!parallel) {
      X_AB.linear() =
          Eigen::AngleAxisd(random.uniform(0, 6), inCube(random).normalized()).toRotationMatrix();
    }
    X_AB.translation() = away - X_AB.linear() * away + size * (2 * inCube(random));
    for (int step = 0; step < 3; ++step) {  // towards the gap
      if (!posed.pose(fcl::Transform3<S>::Identity(), X_AB.cast<S>())) return;
      const AllPairs<S> all = posed.all();
      engine::TreePose pose;
      ASSERT_TRUE(makeTreePose(*posed.tree_a, *posed.tree_b, *posed.X_AB, pose));
      const double bound = rootBound(*posed.tree_a, *posed.tree_b, pose);
      sum.wrong += bound > double{all.distance};
      // Whatever is positive will do, and is found where the best bound is.
      const double any = rootBound(*posed.tree_a, *posed.tree_b, pose, 0);
      sum.wrong += any > double{all.distance} || (any > 0) != (bound > 0) ||
                   any > bound + 1e-6 * std::abs(bound);
      sum.apart += double{all.distance} > 0.2 * size;
      sum.told += double{all.distance} > 0.2 * size && bound > 0.1 * size;
      const fcl::Transform3<S> I = fcl::Transform3<S>::Identity(), X = X_AB.cast<S>();
      bool off = false;
      for (const double margin : {0.0, 0.5, 0.99999, 1.00001}) {
        const double far = margin * double{all.distance};
        const bool is_off =
            isOff(*model_a, I, *model_b, X, far) || isOff(*model_b, X, *model_a, I, far);
        sum.wrong += is_off && (margin > 1 || !(all.distance > 0));
        off |= is_off && margin == 0.5;
      }
      sum.off += off;
      pose.pad = pose.box_pad = 0;
      const double without_pad = rootBound(*posed.tree_a, *posed.tree_b, pose);
      sum.without_pad += without_pad > double{all.distance};
      if (!(all.distance > 0)) break;
      const auto nearest =
          triangleDistance(posed.a.corners(static_cast<std::size_t>(all.nearest.first)),
                           posed.cornersOfB(static_cast<std::size_t>(all.nearest.second)));
      const fcl::Vector3d way = (nearest.point_a - nearest.point_b).template cast<double>();
      X_AB.translation() += (1 - gap * size / double{all.distance}) * way;
    }
  }
}

template <typename S>
Outcome tryMeshes() {
  const Mesh slab = scenes::subdividedBox({2, 1, 0.02}, 2),
             block = scenes::subdividedBox({1, 1, 1}, 1);
  const Mesh sheet = scenes::sheet(1.5, 1, 3, 3, 0), round = scenes::icosphere(0.5, 1);
  // As a floor under small bodies, which its spheres are no use for, though it isn't thin.
  const Mesh ground = scenes::subdividedBox({40, 40, 20}, 1);
  const Mesh plank =
      scenes::moved(fcl::Transform3d(Eigen::AngleAxisd(0.7, fcl::Vector3d(1, 2, 3).normalized())),
                    scenes::subdividedBox({1.5, 0.1, 0.05}, 2));
  Outcome sum;
  std::uint64_t seed = 1;
  for (const double size : {1.0, 1e-6, 1e6}) {
    for (const double offset : {0.0, 1.0, 100.0}) {
      for (const bool parallel : {true, false}) {
        for (int i = 0; i < 3; ++i) {
          tryPoses<S>(slab, block, size, offset, parallel, ++seed, sum);
          tryPoses<S>(sheet, slab, size, offset, parallel, ++seed, sum);
          tryPoses<S>(plank, slab, size, offset, parallel, ++seed, sum);
          tryPoses<S>(round, slab, size, offset, parallel, ++seed, sum);
          tryPoses<S>(slab, round, size, offset, parallel, ++seed, sum);
          tryPoses<S>(ground, round, size, offset, parallel, ++seed, sum);
          tryPoses<S>(block, ground, size, offset, parallel, ++seed, sum);
        }
      }
    }
  }
  return sum;
}

KIOS_SCALAR_SUITE(RootBound);

TYPED_TEST(RootBound, IsAtMostTheDistance) {
  const Outcome sum = tryMeshes<TypeParam>();
  EXPECT_EQ(sum.wrong, 0);
  if (sizeof(TypeParam) == sizeof(float)) {  // it is the pad that makes it right
    EXPECT_GT(sum.without_pad, 50);          // (double: for what the stored floats might lose)
  }
  ASSERT_GT(sum.apart, 100);
  EXPECT_GT(sum.off, 100);
  // A ball fills its box badly, and bodies in the ground are apart from its surface.
  EXPECT_GT(sum.told, 0.5 * static_cast<double>(sum.apart));
}

TYPED_TEST(RootBound, TellsBodiesThatHover) {
  using S = TypeParam;
  const double gap = sizeof(S) == sizeof(double) ? 1e-6 : 1e-2;
  for (const double depth : {0.0, 0.1}) {
    const Mesh place =
        depth > 0 ? scenes::subdividedBox({8, 8, depth}, 1) : scenes::sheet(8, 8, 2, 3, 0);
    for (const Mesh& body :
         {scenes::subdividedBox({0.3, 0.2, 0.15}, 2), scenes::stripCylinder(12, 0.3, 0.05),
          scenes::subdividedBox({0.5, 0.02, 0.02}, 1), scenes::sheet(0.3, 0.2, 1, 1, 0)}) {
      double low = std::numeric_limits<double>::infinity();
      for (const fcl::Vector3d& v : body.vertices) low = std::min(low, v.z());
      const MeshIn<S> a(place), b(body);
      const auto model_a = makeModel<S>(a.vertices, a.triangles),
                 model_b = makeModel<S>(b.vertices, b.triangles);
      prepare(*model_a);
      prepare(*model_b);
      Random random(5);
      for (const fcl::Transform3d& X_W : scenes::randomPoses(20, 3, 7)) {
        const fcl::Transform3d X =
            X_W * Eigen::Translation3d(random.uniform(-1, 1), 0, depth / 2 - low + gap) *
            Eigen::AngleAxisd(random.uniform(0, 6), fcl::Vector3d::UnitZ());
        const fcl::Transform3<S> X_A = X_W.cast<S>(), X_B = X.cast<S>();
        EXPECT_TRUE(isOff(*model_a, X_A, *model_b, X_B, 0.0));
        EXPECT_TRUE(isOff(*model_b, X_B, *model_a, X_A, 0.0));
        EXPECT_FALSE(isOff(*model_a, X_A, *model_b, X_B, 2 * gap));
      }
    }
  }
}

}  // namespace
}  // namespace kios::testing
