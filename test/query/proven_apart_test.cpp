// SPDX-FileCopyrightText: 2026 The fcl_kios authors
// SPDX-License-Identifier: BSD-3-Clause
//
// What roots prove of a pair is true: their bound is at most the distance, of segments, whose boxes
// they are, against long double, of meshes by the kernel over all pairs of triangles, of shapes by
// that of a shape and a triangle. Sizes, places and gaps are those where rounding decides. What is
// plainly apart is told.

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <memory>
#include <stdexcept>
#include <vector>

#include "all_pairs.h"
#include "fcl/mesh_cases.h"
#include "fcl_kios/contact.h"
#include "floating_point_flags.h"
#include "not_finite.h"
#include "query/mesh_contacts.h"
#include "query/posed_solid.h"
#include "scalars.h"
#include "scenes/cad_shapes.h"
#include "shape/shape_oracle.h"
#include "shape/shape_solid.h"
#include "shape/triangle_shape.h"
#include "volume/rotation.h"

namespace kios::testing {
namespace {

using Real = long double;
using RealVec = Eigen::Matrix<Real, 3, 1>;

struct Told {
  long wrong = 0, apart = 0, told = 0;
};

Vector3d direction(Random& random) { return inCube(random).normalized(); }

/// Turns at random, about an axis by a quarter at times, and sheared by up to `shear`.
template <typename S>
fcl::Matrix3<S> turned(Random& random, double shear) {
  const double quarters = std::acos(0.0) * static_cast<int>(random.uniform(0, 4));
  const bool square = random.unit() < 0.3;
  fcl::Matrix3d R = Eigen::AngleAxisd(square ? quarters : random.uniform(0, 7),
                                      square ? Vector3d::UnitZ() : direction(random))
                        .toRotationMatrix();
  for (int i = 0; i < 9; ++i) R(i / 3, i % 3) += random.uniform(-shear, shear);
  return R.cast<S>();
}

KIOS_SCALAR_SUITE(ProvenApart);

TYPED_TEST(ProvenApart, BoundsTheDistanceOfSegments) {
  using S = TypeParam;
  Random random(7);
  Told sum;
  for (int i = 0; i < 40'000; ++i) {
    const double size = std::exp2(random.uniform(-25, 25)), shear = i % 3 ? 0 : 1e-6;
    const double offset = i % 2 ? 0 : size * std::exp2(random.uniform(-2, 12));
    const double gap = size * std::exp2(random.uniform(-40, 1));
    // They cross, at their ends at times, `gap` apart.
    const Vector3d d = direction(random), e = direction(random);
    const Vector3d away = offset * direction(random), n = d.cross(e).normalized();
    const auto part = [&] {
      return random.unit() < 0.3 ? std::round(random.unit()) : random.unit();
    };
    const double s = part(), t = part();
    const auto segment = [&](const Vector3d& along, double at, const Vector3d& place) {
      const Vector3d from = away + place - at * size * along, to = from + size * along;
      return scenes::buildModel<kIOS<S>>(scenes::singleTriangle(from, to, to));
    };
    fcl::Transform3<S> X_WA = fcl::Transform3<S>::Identity(), X_WB = X_WA;
    X_WA.linear() = turned<S>(random, shear);
    X_WB.linear() = turned<S>(random, shear);
    const auto a = segment(d, s, Vector3d::Zero());
    const Vector3d in_b = X_WB.linear().template cast<double>().transpose() *
                          (X_WA.linear().template cast<double>() * e);
    const auto b = segment(in_b, t, Vector3d::Zero());
    X_WA.translation() = (size * random.unit() * direction(random)).template cast<S>();
    X_WB.translation() =
        (X_WA * (away + gap * n).template cast<S>() - X_WB.linear() * away.template cast<S>());
    RealVec p[2], q[2];
    const auto R_AW = X_WA.linear().transpose().template cast<Real>();
    const RealVec between =
        (X_WB.translation().template cast<Real>() - X_WA.translation().template cast<Real>());
    for (int k = 0; k < 2; ++k) {
      p[k] = a->vertices[k].template cast<Real>();
      q[k] = R_AW *
             (X_WB.linear().template cast<Real>() * b->vertices[k].template cast<Real>() + between);
    }
    const Real distance = scenes::triangleDistance({p[0], p[1], p[1]}, {q[0], q[1], q[1]});
    const MeshPair pair(meshOf(*a), X_WA, meshOf(*b), X_WB);
    const double best = pair.rootBound(kInfinity), any = pair.rootBound(0);
    sum.wrong += Real{best} > distance || Real{any} > distance || (any > 0) != (best > 0);
    const bool is_off =
        engine::ballsApart(a->getBV(0).bv.center0, X_WA, b->getBV(0).bv.center0, X_WB,
                           double{a->getBV(0).bv.radius0} + double{b->getBV(0).bv.radius0},
                           squaredRotationErrors(X_WA, X_WB), 0.999 * gap);
    sum.wrong += is_off && !(distance > Real{0.999 * gap});
    if (shear > 0 || offset > 0 || sizeof(S) == sizeof(float)) continue;
    sum.apart += distance > Real{1e-5 * size};
    sum.told += distance > Real{1e-5 * size} && best > 0;
  }
  EXPECT_EQ(sum.wrong, 0);
  EXPECT_GE(sum.told, 0.95 * static_cast<double>(sum.apart));
  EXPECT_EQ(sum.apart > 5000, sizeof(S) == sizeof(double));
}

/// Both meshes at poses where they are `gap` apart, or nearly so.
template <typename S>
void tryPoses(const Mesh& mesh_a, const Mesh& mesh_b, double size, double offset, bool parallel,
              std::uint64_t seed, Told& sum) {
  Random random(seed);
  const fcl::Vector3d away = offset * size * inCube(random);
  const auto a = scenes::buildModel<kIOS<S>>(transformed(mesh_a, size, away));
  const auto b = scenes::buildModel<kIOS<S>>(transformed(mesh_b, size, away));
  for (const double gap : {0.0, 1e-7, 1e-4, 1e-2, 0.3}) {
    fcl::Transform3d X_AB = fcl::Transform3d::Identity();
    if (!parallel) X_AB.linear() = turned<double>(random, 0);
    X_AB.translation() = away - X_AB.linear() * away + size * (2 * inCube(random));
    for (int step = 0; step < 3; ++step) {  // towards the gap
      const MeshPair pair(meshOf(*a), fcl::Transform3<S>::Identity(), meshOf(*b), X_AB.cast<S>());
      const AllPairs all(trianglesOf(*a), trianglesOf(*b), pair.X_AB);
      const double distance = all.distance;
      const double best = pair.rootBound(kInfinity), any = pair.rootBound(0);
      sum.wrong += best > distance || any > distance || (any > 0) != (best > 0);
      sum.apart += distance > 0.2 * size;
      sum.told += distance > 0.2 * size && best > 0.1 * size;
      if (!(distance > 0)) break;
      const auto nearest = pair.distanceOf({all.nearest.first, all.nearest.second});
      const fcl::Vector3d way = nearest.point_a - nearest.point_b;
      X_AB.translation() += (1 - gap * size / distance) * way;
    }
  }
}

TYPED_TEST(ProvenApart, BoundsTheDistanceOfMeshes) {
  const Mesh slab = scenes::subdividedBox({2, 1, 0.02}, 2),
             block = scenes::subdividedBox({1, 1, 1}, 1);
  const Mesh sheet = scenes::sheet(1.5, 1, 3, 3, 0), round = scenes::icosphere(0.5, 1);
  // As a floor under small bodies, which its spheres are no use for, though it isn't thin.
  const Mesh ground = scenes::subdividedBox({40, 40, 20}, 1);
  const Mesh plank =
      scenes::moved(fcl::Transform3d(Eigen::AngleAxisd(0.7, fcl::Vector3d(1, 2, 3).normalized())),
                    scenes::subdividedBox({1.5, 0.1, 0.05}, 2));
  const std::pair<const Mesh&, const Mesh&> pairs[] = {
      {slab, block}, {sheet, slab},   {plank, slab},  {round, slab},
      {slab, round}, {ground, round}, {block, ground}};
  Told sum;
  std::uint64_t seed = 1;
  for (const double size : {1.0, 1e-6, 1e6}) {
    for (const double offset : {0.0, 1.0, 100.0}) {
      for (const bool parallel : {true, false}) {
        for (int i = 0; i < 3; ++i) {
          for (const auto& [a, b] : pairs) {
            tryPoses<TypeParam>(a, b, size, offset, parallel, ++seed, sum);
          }
        }
      }
    }
  }
  EXPECT_EQ(sum.wrong, 0);
  ASSERT_GT(sum.apart, 100);
  // A ball fills its box badly, and bodies in the ground are apart from its surface.
  EXPECT_GT(sum.told, 0.5 * static_cast<double>(sum.apart));
}

TYPED_TEST(ProvenApart, IsNotOfBallsThatCantBeBounded) {
  using S = TypeParam;
  const fcl::Vector3d c = fcl::Vector3d::Zero();
  const auto apart = [&](const fcl::Transform3<S>& X, double radii, double errors, double margin) {
    return engine::ballsApart(c, fcl::Transform3<S>::Identity(), c, X, radii, errors, margin) ||
           engine::ballsApart(c, X, c, fcl::Transform3<S>::Identity(), radii, errors, margin);
  };
  fcl::Transform3<S> X(Eigen::Translation<S, 3>(3, 0, 0));
  EXPECT_TRUE(apart(X, 1, 0, 1.9));
  EXPECT_FALSE(apart(X, 1, 0, 2.1));
  EXPECT_FALSE(apart(X, 1, 1e-6, 0));
  for (const double bad : {kNaN, kInfinity, -kInfinity, 0x1p41, -0x1p100, 0x1p-110}) {
    if (std::abs(bad) != 0x1p-110) {
      EXPECT_FALSE(apart(X, 1, 0, std::abs(bad)));
    }
    fcl::Transform3<S> X_bad = fcl::Transform3<S>::Identity();
    for (int i = 0; i < 3; ++i) {
      X_bad.translation()[i] = static_cast<S>(bad);
      EXPECT_FALSE(apart(X_bad, 0, 0, 0)) << bad;
    }
  }
}

struct Place {
  double scale = 1, world = 0, stretch = 0;
  Vector3d offset = Vector3d::Zero();  ///< of the mesh in its own frame
};

template <typename S>
struct ShapePair {
  const Model<S>& model;
  const fcl::CollisionGeometry<S>& shape;
  fcl::Transform3<S> X_WM, X_WS;

  /// Takes the exact distance, and moves the shape so that `gap` of it is left, or nearly so.
  void judge(double size, double gap, Told& sum) {
    const PosedSolid posed(toSolid(shape), X_WM, X_WS, meshOf(model));
    double distance = kInfinity;
    shape::Vec way = shape::Vec::Zero();
    for (int i = 0; i < model.num_tris; ++i) {
      const auto d =
          shape::distance(posed.solid(), posed.place(cornersInDouble(model, i)), kInfinity);
      if (!(d.distance < distance)) continue;
      distance = d.distance;
      way = d.on_triangle - d.on_shape;
    }
    bool told = false;
    for (const double part : {0.0, 0.5, 0.999, 1.0, 1.001}) {
      const double margin = part * distance;
      const bool off = provenApart(meshOf(model), X_WM, toSolid(shape), X_WS,
                                   squaredRotationErrors(X_WS, X_WM), margin);
      sum.wrong += off && !(distance > margin);
      told |= off && part == 0.5;
    }
    sum.apart += distance > 2 * size;
    sum.told += told && distance > 2 * size;
    if (!(distance > 0)) return;
    X_WS.translation() += X_WS.linear() * ((1 - gap) * way).template cast<S>();
  }
};

template <typename S>
void tryPlace(Shape kind, const Mesh& mesh, const Place& place, Told& sum) {
  Mesh placed = mesh;
  for (Vector3d& p : placed.vertices) p = place.scale * (p + place.offset);
  const auto model = scenes::buildModel<kIOS<S>>(placed);
  Random random(11);
  for (const Frame& frame : randomFrames(30, 4 * place.scale, 17)) {
    ShapeSpec spec = randomShape(kind, random);
    const double much = random.unit() < 0.3 ? 30 : 1;
    if (kind < Shape::kHalfspace) spec.size *= much * place.scale;
    spec.offset *= place.scale;
    for (auto& p : spec.hull.vertices) p *= much * place.scale;
    const auto shape = makeShape<S>(spec);
    ShapePair<S> pair{*model, *shape, frame.X_WA.cast<S>(), frame.X_WB.cast<S>()};
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

class ProvenApartFromShape : public ::testing::TestWithParam<Shape> {};

TEST_P(ProvenApartFromShape, BoundsTheDistanceInDouble) { tryAll<double>(GetParam()); }
TEST_P(ProvenApartFromShape, BoundsTheDistanceInFloat) { tryAll<float>(GetParam()); }

INSTANTIATE_TEST_SUITE_P(Shapes, ProvenApartFromShape, ::testing::ValuesIn(kShapes), NameOfShape());

TEST(ProvenApartFromShape, IsNotOfVerticesThatAreNone) {
  const auto model = scenes::buildModel<kIOS<double>>(scenes::bumpyTorus(200));
  fcl::Transform3d X_WM = fcl::Transform3d::Identity();
  X_WM.translation().x() = 100;
  const auto collides = [&](const fcl::CollisionGeometryd& shape) {
    fcl::CollisionResultd result;
    return collideShape<double>(*model, X_WM, shape, fcl::Transform3d::Identity(),
                                fcl::CollisionRequestd(), result);
  };
  Random random(3);
  for (const double value : {kNaN, kInfinity, -kInfinity}) {
    for (int i = 0; i < 3; ++i) {
      ShapeSpec spec = randomShape(Shape::kConvex, random);
      EXPECT_EQ(collides(*makeShape<double>(spec)), 0U);
      spec.hull.vertices[static_cast<std::size_t>(3 * i % 6)][i] = value;
      EXPECT_THROW(collides(*makeShape<double>(spec)), std::invalid_argument);
    }
  }
  const auto vertices = std::make_shared<std::vector<fcl::Vector3d>>();
  const auto faces = std::make_shared<std::vector<int>>(std::vector<int>{3, 0, 1, 2});
  *vertices = {{0, 0, 0}, {1, 0, 0}, {0, 1, 0}};
  const fcl::Convexd shape(vertices, 1, faces);
  EXPECT_EQ(collides(shape), 0U);
  vertices->clear();
  EXPECT_THROW(collides(shape), std::invalid_argument);
}

// Products of such lengths overflow, and their sums are then none.
TEST_P(ProvenApartFromShape, RaisesNoFlagsAtTheLargestLengths) {
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
        flags.during("provenApart", [&] {
          provenApart(meshOf(*model), fcl::Transform3d::Identity(), toSolid(*shape), X_WS, 0, 0);
        });
      }
    }
  }
}

}  // namespace
}  // namespace kios::testing
