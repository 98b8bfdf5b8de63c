// SPDX-FileCopyrightText: 2026 The fcl_kios authors
// SPDX-License-Identifier: BSD-3-Clause
//
// What the root of a mesh proves off a shape, by its central sphere or its box, is: a margin of the
// exact distance is never proven, also of single points, whose spheres and boxes are the points but
// for rounding. What is plainly apart is told.

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <memory>
#include <stdexcept>
#include <vector>

#include "fcl/mesh_cases.h"
#include "fcl_kios/model/prepare.h"
#include "fcl_kios/query/shape_queries.h"
#include "floating_point_flags.h"
#include "not_finite.h"
#include "query/mesh_contacts.h"
#include "query/posed_solid.h"
#include "query/root_off_shape.h"
#include "scenes/cad_shapes.h"
#include "shape/shape_oracle.h"
#include "shape/shape_solid.h"
#include "shape/triangle_shape.h"
#include "volume/rotation.h"

namespace kios::testing {
namespace {

struct Told {
  int wrong = 0, apart = 0, told = 0;
};

struct Place {
  double scale = 1, world = 0, stretch = 0;
  Vector3d offset = Vector3d::Zero();  ///< of the mesh in its own frame
};

template <typename S>
class Pair {
 public:
  Pair(const fcl::BVHModel<kIOS<S>>& model, const fcl::CollisionGeometry<S>& shape)
      : model_(model), shape_(shape) {}

  fcl::Transform3<S> X_WM, X_WS;

  /// Takes the exact distance, and moves the shape so that `gap` of it is left, or nearly so.
  void judge(double size, double gap, Told& sum) {
    const PosedSolid<S> posed(toSolid(shape_), X_WM, X_WS, model_.getBV(0).bv);
    double distance = kInfinity;
    shape::Vec way = shape::Vec::Zero();
    for (int i = 0; i < model_.num_tris; ++i) {
      const auto d = shape::distance(posed.solid(), posed.place(cornersOf(model_, i)), kInfinity);
      if (!(d.distance < distance)) continue;
      distance = d.distance;
      way = d.on_triangle - d.on_shape;
    }
    bool told = false;
    for (const double part : {0.0, 0.5, 0.999, 1.0, 1.001}) {
      const double margin = part * distance;
      const bool off =
          rootOffShape(model_, X_WM, shape_, X_WS, squaredRotationErrors(X_WS, X_WM), margin);
      sum.wrong += off && !(distance > margin);
      told |= off && part == 0.5;
    }
    sum.apart += distance > 2 * size;
    sum.told += told && distance > 2 * size;
    if (!(distance > 0)) return;
    X_WS.translation() += X_WS.linear() * ((1 - gap) * way).template cast<S>();
  }

 private:
  const fcl::BVHModel<kIOS<S>>& model_;
  const fcl::CollisionGeometry<S>& shape_;
};

template <typename S>
void tryPlace(Shape kind, const Mesh& mesh, const Place& place, Told& sum) {
  Mesh placed = mesh;
  for (Vector3d& p : placed.vertices) p = place.scale * (p + place.offset);
  const auto model = scenes::buildModel<kIOS<S>>(placed);
  prepare(*model);
  Random random(11);
  for (const Frame& frame : randomFrames(30, 4 * place.scale, 17)) {
    ShapeSpec spec = randomShape(kind, random);
    const double much = random.unit() < 0.3 ? 30 : 1;
    if (kind < Shape::kHalfspace) spec.size *= much * place.scale;
    spec.offset *= place.scale;
    for (auto& p : spec.hull.vertices) p *= much * place.scale;
    const auto shape = makeShape<S>(spec);
    Pair<S> pair(*model, *shape);
    pair.X_WM = frame.X_WA.cast<S>();
    pair.X_WS = frame.X_WB.cast<S>();
    pair.X_WM.linear() *= static_cast<S>(1 + place.stretch);
    pair.X_WM.translation() -= pair.X_WM.linear() * (place.scale * place.offset).cast<S>();
    pair.X_WM.translation().array() += static_cast<S>(place.world);
    pair.X_WS.translation().array() += static_cast<S>(place.world);
    for (const double gap : {0.1, 1e-3, 1e-6, 1.0}) pair.judge(place.scale, gap, sum);
  }
}

template <typename S>
void tryAll(Shape kind) {
  const double far = sizeof(S) == sizeof(double) ? 1e6 : 1e2;
  Told sum;
  for (const Mesh& mesh :
       {scenes::singleTriangle({0, 0, 0}, {0, 0, 0}, {0, 0, 0}),
        scenes::singleTriangle({0, 0, 0}, {0.4, 0, 0}, {0, 0.3, 0.1}), scenes::bumpyTorus(200),
        scenes::subdividedBox({2, 1, 0.02}, 2), scenes::subdividedBox({40, 40, 1}, 1)}) {
    for (const double scale : {1.0, 1e-6, 1e6}) {
      for (const double offset : {0.0, 1.0, far}) {
        Place place;
        place.scale = scale;
        place.offset = offset * Vector3d(1, -0.3, 0.7);
        tryPlace<S>(kind, mesh, place, sum);
      }
    }
    Place place;
    place.world = far;
    tryPlace<S>(kind, mesh, place, sum);
    for (const double sign : {-1.0, 1.0}) {
      place = {};
      place.offset = far * Vector3d(1, -0.3, 0.7);
      place.stretch = sign * (sizeof(S) == sizeof(double) ? 1e-12 : 1e-5);
      tryPlace<S>(kind, mesh, place, sum);
    }
  }
  EXPECT_EQ(sum.wrong, 0);
  EXPECT_GT(sum.told, 8 * sum.apart / 10);  // lengths of 2^40 prove nothing
}

class RootOffShape : public ::testing::TestWithParam<Shape> {};

TEST_P(RootOffShape, IsProvenInDouble) { tryAll<double>(GetParam()); }
TEST_P(RootOffShape, IsProvenInFloat) { tryAll<float>(GetParam()); }

INSTANTIATE_TEST_SUITE_P(Shapes, RootOffShape, ::testing::ValuesIn(kShapes), NameOfShape());

// A convex shape is looked at before its vertices are checked.
TEST(RootOffShape, IsNeverProvenOfVerticesThatAreNone) {
  const auto model = scenes::buildModel<kIOS<double>>(scenes::bumpyTorus(200));
  fcl::Transform3d X_WS = fcl::Transform3d::Identity();
  X_WS.translation().x() = 100;
  Random random(3);
  for (const double value : {kNaN, kInfinity, -kInfinity}) {
    for (int i = 0; i < 3; ++i) {
      ShapeSpec spec = randomShape(Shape::kConvex, random);
      EXPECT_TRUE(
          rootOffShape(*model, X_WS, *makeShape<double>(spec), fcl::Transform3d::Identity(), 0, 0));
      spec.hull.vertices[static_cast<std::size_t>(3 * i % 6)][i] = value;
      EXPECT_FALSE(
          rootOffShape(*model, X_WS, *makeShape<double>(spec), fcl::Transform3d::Identity(), 0, 0));
    }
  }
}

TEST(RootOffShape, IsNeverProvenOfNoVertices) {
  const auto model = scenes::buildModel<kIOS<double>>(scenes::bumpyTorus(200));
  prepare(*model);
  const scenes::Mesh hull = scenes::icosphere(1, 0);
  const auto vertices = std::make_shared<std::vector<fcl::Vector3d>>(hull.vertices);
  const auto faces = std::make_shared<std::vector<int>>();
  for (const fcl::Triangle& t : hull.triangles) {
    faces->push_back(3);
    for (int i = 0; i < 3; ++i) faces->push_back(static_cast<int>(t[i]));
  }
  const fcl::Convexd shape(vertices, static_cast<int>(hull.triangles.size()), faces);
  fcl::Transform3d X_WM = fcl::Transform3d::Identity();
  X_WM.translation().x() = 100;
  const auto isOff = [&] {
    return rootOffShape<double>(*model, X_WM, shape, fcl::Transform3d::Identity(), 0, 0);
  };
  EXPECT_TRUE(isOff());
  vertices->clear();
  EXPECT_FALSE(isOff());
  fcl::CollisionResultd result;
  EXPECT_THROW(collideShape<double>(*model, X_WM, shape, fcl::Transform3d::Identity(),
                                    fcl::CollisionRequestd(), result),
               std::invalid_argument);
}

// Products of such lengths overflow, and their sums are then none.
TEST_P(RootOffShape, RaisesNoFlagsAtTheLargestLengths) {
  const double lengths[] = {0x1p-990, 0x1p36, 0x1p600, 0x1p998};
  Flags flags;
  Random random(5);
  for (const double scale : lengths) {
    ShapeSpec spec = randomShape(GetParam(), random);
    if (GetParam() < Shape::kHalfspace) spec.size *= scale;
    spec.offset *= scale;
    for (auto& p : spec.hull.vertices) p *= scale;
    const auto shape = makeShape<double>(spec);
    for (const double size : {1.0, 0x1p990}) {
      const auto model = scenes::buildModel<kIOS<double>>(
          scenes::singleTriangle({0, 0, 0}, {size, 0, 0}, {0, size, size}));
      for (const double far : lengths) {
        fcl::Transform3d X_WS = scenes::randomPoses(1, 1, 7)[0];
        X_WS.translation() = far * Vector3d(1, -1, 1);
        flags.during("rootOffShape", [&] {
          rootOffShape(*model, fcl::Transform3d::Identity(), *shape, X_WS, 0, 0);
        });
      }
    }
  }
}

}  // namespace
}  // namespace kios::testing
