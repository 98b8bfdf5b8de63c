// SPDX-FileCopyrightText: 2026 The fcl_kios authors
// SPDX-License-Identifier: BSD-3-Clause
//
// fcl::collide and fcl::distance of a mesh over k-IOS and each of FCL's shapes: against the oracle
// over all triangles, in both orders, with both solvers, in double and float.

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <set>

#include <fcl/narrowphase/detail/gjk_solver_indep.h>
#include <fcl/narrowphase/detail/gjk_solver_libccd.h>

#include "fcl/mesh_cases.h"
#include "shape/shape_oracle.h"

namespace kios::testing {
namespace {

/// Holds a mesh and a shape of scalar S at poses of S, with the oracle over all triangles.
template <typename S>
struct Scene {
  Mesh mesh;
  ShapeSpec spec;
  std::shared_ptr<fcl::BVHModel<kIOS<S>>> model;
  std::shared_ptr<fcl::CollisionGeometry<S>> shape;
  fcl::Transform3<S> X_WM, X_WS;

  Scene(Mesh m, ShapeSpec s) : mesh(std::move(m)), spec(std::move(s)) {
    model = scenes::buildModel<kIOS<S>>(mesh);
    shape = makeShape<S>(spec);
    // as stored
    for (auto& p : mesh.vertices) p = p.template cast<S>().template cast<double>();
    if (spec.kind == Shape::kPlane) asStored(static_cast<const fcl::Plane<S>&>(*shape));
    if (spec.kind == Shape::kHalfspace) asStored(static_cast<const fcl::Halfspace<S>&>(*shape));
  }

  template <typename FclPlane>
  void asStored(const FclPlane& plane) {
    spec.size = plane.n.template cast<double>();
    spec.offset = double{plane.d} / spec.size.norm();
    spec.size.normalize();
  }

  void pose(const Frame& frame) {
    X_WM = fcl::Transform3<S>(frame.X_WA.cast<S>());
    X_WS = fcl::Transform3<S>(frame.X_WB.cast<S>());
  }

  ExactTriangle placed(std::size_t i) const {  // in the shape's frame
    ExactTriangle t;
    const auto c = corners(mesh, static_cast<std::intptr_t>(i));
    for (int k = 0; k < 3; ++k) {
      t[k] =
          X_WS.linear().template cast<Real>().transpose() *
          (X_WM.linear().template cast<Real>() * c[k].template cast<Real>() +
           (X_WM.translation().template cast<Real>() - X_WS.translation().template cast<Real>()));
    }
    return t;
  }

  /// Returns the distance by the oracle; triangles that a sphere around them keeps farther are
  /// skipped.
  Real distance() const {
    Real best = std::numeric_limits<Real>::max();
    for (std::size_t i = 0; i < mesh.triangles.size(); ++i) {
      const ExactTriangle t = placed(i);
      const ExactPoint c = (t[0] + t[1] + t[2]) / 3;
      const Real r = std::max({(t[0] - c).norm(), (t[1] - c).norm(), (t[2] - c).norm()});
      const Real to_center = level(spec, c, true);
      if (spec.kind != Shape::kPlane && to_center - r >= best) continue;
      best = std::min(best, oracleDistance(spec, t));
      if (best == 0) break;
    }
    return best;
  }

  /// Triangles that meet the shape by more than `band`, and those within it.
  void hits(double band, std::set<int>& sure, std::set<int>& either) const {
    for (std::size_t i = 0; i < mesh.triangles.size(); ++i) {
      const ExactTriangle t = placed(i);
      const ExactPoint c = (t[0] + t[1] + t[2]) / 3;
      const Real r = std::max({(t[0] - c).norm(), (t[1] - c).norm(), (t[2] - c).norm()});
      if (spec.kind != Shape::kPlane && spec.kind != Shape::kEllipsoid &&
          level(spec, c, false) - r > band) {
        continue;
      }
      const Real depth = leastLevel(spec, t, false);
      if (depth < -band) sure.insert(static_cast<int>(i));
      if (std::abs(depth) <= band) either.insert(static_cast<int>(i));
    }
  }

  double size() const { return scenes::extent(mesh) + spec.size.norm(); }
};

std::vector<Mesh> meshes() {
  return {scenes::bumpyTorus(160), scenes::randomSoup(40, 1, 1e-2, 1, 3), scenes::icosphere(1.5, 1),
          scenes::singleTriangle({0.3, 0.1, -0.2}, {-0.4, 0.7, 0.1}, {0.2, -0.5, 0.6})};
}

template <typename S>
void checkDistances(Shape kind) {
  constexpr bool kDouble = std::is_same_v<S, double>;
  scenes::Random random(7);
  int apart = 0, touching = 0;
  for (const Mesh& mesh : meshes()) {
    for (int i = 0; i < (kind == Shape::kEllipsoid ? 3 : 6); ++i) {  // a slow oracle
      Scene<S> scene(mesh, randomShape(kind, random));
      const Vector3d offset = i % 4 == 3 && kDouble ? Vector3d(1e9, -1e9, 3e8) : Vector3d(0, 0, 0);
      scene.pose(randomFrames(1, i % 2 == 0 ? 1 : 3, 100 * i + 5, offset).front());
      const double tolerance = (kDouble ? 2e-14 : 3e-7) * (scene.size() + 3);
      const double expected = static_cast<double>(scene.distance());
      for (const bool turned : {false, true}) {
        fcl::DistanceRequest<S> request(true);
        request.gjk_solver_type = i % 2 == 0 ? fcl::GST_LIBCCD : fcl::GST_INDEP;
        request.enable_signed_distance = i % 3 == 0;
        fcl::DistanceResult<S> result;
        const fcl::CollisionGeometry<S>*m = scene.model.get(), *s = scene.shape.get();
        const S d = turned ? fcl::distance(s, scene.X_WS, m, scene.X_WM, request, result)
                           : fcl::distance(m, scene.X_WM, s, scene.X_WS, request, result);
        EXPECT_EQ(d, result.min_distance);
        EXPECT_NEAR(d, expected, tolerance);
        EXPECT_EQ(result.o1, m);
        EXPECT_EQ(result.o2, s);
        EXPECT_EQ(result.b2, -1);  // NONE
        ASSERT_GE(result.b1, 0);
        const double world = (kDouble ? 1e-15 : 1e-6) * (scene.X_WM.translation().norm() + 10);
        EXPECT_NEAR((result.nearest_points[0] - result.nearest_points[1]).norm(), d, world);
        EXPECT_LE(distanceToTriangle(result.nearest_points[0].template cast<double>(),
                                     scene.X_WM.template cast<double>(), scene.mesh, result.b1),
                  world);
        const ExactPoint on_shape = scene.X_WS.linear().template cast<Real>().transpose() *
                                    (result.nearest_points[1].template cast<Real>() -
                                     scene.X_WS.translation().template cast<Real>());
        EXPECT_LE(
            std::abs(static_cast<double>(std::max(Real(0), level(scene.spec, on_shape, true)))),
            2 * world);
        if (std::abs(expected) > tolerance) {
          EXPECT_GT(d, 0);
        }
        ++(d > 0 ? apart : touching);
      }
    }
  }
  EXPECT_GT(apart, 5);
  EXPECT_GT(touching, 0);
}

template <typename S>
void checkCollisions(Shape kind) {
  constexpr bool kDouble = std::is_same_v<S, double>;
  scenes::Random random(17);
  std::size_t contacts = 0, clear = 0;
  for (const Mesh& mesh : meshes()) {
    for (int i = 0; i < (kind == Shape::kConvex ? 3 : 4); ++i) {  // a slow oracle
      Scene<S> scene(mesh, randomShape(kind, random));
      scene.pose(randomFrames(1, 1, 100 * i + 9).front());
      std::set<int> sure, either;
      scene.hits((kDouble ? 1e-14 : 1e-6) * (scene.size() + 3), sure, either);
      const fcl::CollisionGeometry<S>*m = scene.model.get(), *s = scene.shape.get();
      for (const bool enable_contact : {false, true}) {
        fcl::CollisionRequest<S> request(kAllContacts, enable_contact);
        request.gjk_solver_type = i % 2 == 0 ? fcl::GST_LIBCCD : fcl::GST_INDEP;
        fcl::CollisionResult<S> result, turned;
        const std::size_t n = fcl::collide(m, scene.X_WM, s, scene.X_WS, request, result);
        EXPECT_EQ(n, fcl::collide(s, scene.X_WS, m, scene.X_WM, request, turned));
        EXPECT_EQ(n, result.numContacts());
        std::set<int> found;
        for (std::size_t c = 0; c < n; ++c) {
          const auto& contact = result.getContact(c);
          EXPECT_TRUE(found.insert(static_cast<int>(contact.b1)).second);
          EXPECT_EQ(contact.o1, m);
          EXPECT_EQ(contact.o2, s);
          EXPECT_EQ(contact.b2, -1);  // NONE
          EXPECT_EQ(turned.getContact(c).o1, m);
          EXPECT_EQ(turned.getContact(c).b1, contact.b1);
          if (!enable_contact) continue;
          EXPECT_NEAR(contact.normal.norm(), 1, 1e-6);
          EXPECT_GE(contact.penetration_depth, 0);
          // Moving the triangle out along the normal ends the overlap.
          ExactTriangle t = scene.placed(static_cast<std::size_t>(contact.b1));
          const ExactPoint out =
              scene.X_WS.linear().template cast<Real>().transpose() *
              (-contact.normal * contact.penetration_depth).template cast<Real>();
          for (auto& p : t) p += out;
          EXPECT_GE(static_cast<double>(leastLevel(scene.spec, t, false)),
                    -(kDouble ? 1e-8 : 1e-5) * scene.size());
          if (kind == Shape::kHalfspace) continue;
          EXPECT_LE(distanceToTriangle(contact.pos.template cast<double>(),
                                       scene.X_WM.template cast<double>(), scene.mesh, contact.b1),
                    (kDouble ? 1e-12 : 1e-5));
        }
        for (const int id : sure) EXPECT_TRUE(found.count(id)) << id;
        for (const int id : found) EXPECT_TRUE(sure.count(id) || either.count(id)) << id;
        (n > 0 ? contacts : clear) += std::max<std::size_t>(1, n);
        fcl::CollisionResult<S> first;
        EXPECT_EQ(fcl::collide(m, scene.X_WM, s, scene.X_WS,
                               fcl::CollisionRequest<S>(1, enable_contact), first),
                  std::min<std::size_t>(n, 1));
        fcl::CollisionResult<S> few;
        EXPECT_EQ(fcl::collide(m, scene.X_WM, s, scene.X_WS,
                               fcl::CollisionRequest<S>(3, enable_contact), few),
                  std::min<std::size_t>(n, 3));
      }
    }
  }
  EXPECT_GT(contacts, 5u);
  EXPECT_GT(clear, 0u);
}

class Queries : public ::testing::TestWithParam<Shape> {};

TEST_P(Queries, DistancesInDouble) { checkDistances<double>(GetParam()); }
TEST_P(Queries, DistancesInFloat) { checkDistances<float>(GetParam()); }
TEST_P(Queries, CollisionsInDouble) { checkCollisions<double>(GetParam()); }
TEST_P(Queries, CollisionsInFloat) { checkCollisions<float>(GetParam()); }

// Solver objects as arguments change nothing.
TEST_P(Queries, SolversAsArguments) {
  scenes::Random random(3);
  Scene<double> scene(scenes::bumpyTorus(160), randomShape(GetParam(), random));
  scene.pose(randomFrames(1, 1, 4).front());
  const fcl::CollisionGeometryd *m = scene.model.get(), *s = scene.shape.get();
  const auto &X = scene.X_WM, &Y = scene.X_WS;
  const fcl::detail::GJKSolver_libccd<double> libccd;
  const fcl::detail::GJKSolver_indep<double> indep;
  const fcl::DistanceRequestd request(true);
  fcl::DistanceResultd p, q, r;
  const double d = fcl::distance(m, X, s, Y, request, p);
  EXPECT_EQ(fcl::distance(m, X, s, Y, &libccd, request, q), d);
  EXPECT_EQ(fcl::distance(s, Y, m, X, &indep, request, r), d);
  const fcl::CollisionRequestd all(kAllContacts, true);
  fcl::CollisionResultd a, b, c;
  const std::size_t n = fcl::collide(m, X, s, Y, all, a);
  EXPECT_EQ(fcl::collide(m, X, s, Y, &libccd, all, b), n);
  EXPECT_EQ(fcl::collide(s, Y, m, X, &indep, all, c), n);
}

INSTANTIATE_TEST_SUITE_P(Shapes, Queries, ::testing::ValuesIn(kShapes), NameOfShape());

}  // namespace
}  // namespace kios::testing
