// SPDX-FileCopyrightText: 2026 The fcl_kios authors
// SPDX-License-Identifier: BSD-3-Clause
//
// fcl::collide and fcl::distance of a mesh over k-IOS and each of FCL's shapes, in both orders,
// with both solvers, in double and float, against the kernel over all triangles, which
// near_contact_test judges: the nearest triangle is the least of those whose distances are bitwise
// the least; contacts are those of all triangles, in one order.

#include <gtest/gtest.h>

#include <algorithm>
#include <limits>
#include <numeric>
#include <random>
#include <set>

#include <fcl/narrowphase/detail/gjk_solver_indep.h>
#include <fcl/narrowphase/detail/gjk_solver_libccd.h>

#include "fcl/mesh_cases.h"
#include "fcl_kios/model.h"
#include "not_finite.h"
#include "query/mesh_contacts.h"
#include "query/posed_solid.h"
#include "shape/convex_faces.h"
#include "shape/shape_oracle.h"
#include "shape/shape_solid.h"
#include "shape/triangle_shape.h"

namespace kios::testing {
namespace {

template <typename S>
struct Brute {
  double distance = kInfinity;
  int id = -1;
  std::set<int> hits;

  Brute(const fcl::BVHModel<kIOS<S>>& model, const fcl::Transform3<S>& X_WM,
        const fcl::CollisionGeometry<S>& shape, const fcl::Transform3<S>& X_WS) {
    const PosedSolid posed(toSolid(shape), X_WM, X_WS, meshOf(model));
    const shape::ConvexFaces faces(posed.solid());
    for (int i = 0; i < model.num_tris; ++i) {
      const shape::Triangle t = posed.place(cornersInDouble(model, i));
      const double d = shape::distance(posed.solid(), t, kInfinity).distance;
      const bool meets = shape::intersects(posed.solid(), t);
      EXPECT_EQ(meets, shape::intersects(posed.solid(), t, &faces));
      if (meets) hits.insert(i);
      if (!(d < distance)) continue;
      distance = d;
      id = i;
    }
  }
};

template <typename S>
std::vector<int> contactsOf(const fcl::CollisionResult<S>& result) {
  std::vector<int> ids;
  for (std::size_t i = 0; i < result.numContacts(); ++i) {
    ids.push_back(static_cast<int>(result.getContact(i).b1));
  }
  return ids;
}

template <typename S>
class Compare {
 public:
  int apart = 0, contacts = 0;

  void operator()(const Mesh& mesh, const ShapeSpec& spec, const fcl::Transform3d& X_M,
                  const fcl::Transform3d& X_S) {
    const auto model = scenes::buildModel<kIOS<S>>(mesh);
    const auto shape = makeShape<S>(spec);
    m_ = model.get();
    s_ = shape.get();
    X_WM_ = fcl::Transform3<S>(X_M.cast<S>());
    X_WS_ = fcl::Transform3<S>(X_S.cast<S>());
    solver_ = ++calls_ % 2 == 0 ? fcl::GST_LIBCCD : fcl::GST_INDEP;
    const Brute<S> brute(*model, X_WM_, *shape, X_WS_);
    checkContacts(mesh, spec, brute);
    checkDistance(mesh, spec, brute);

    fcl::DistanceResult<S> result;
    const fcl::DistanceRequest<S> request(true);
    const S d = distanceShape(*model, X_WM_, *shape, X_WS_, request, result);
    fcl::DistanceResult<S> within(static_cast<S>(std::nextafter(d, 2 * d)));
    EXPECT_EQ(distanceShape(*model, X_WM_, *shape, X_WS_, request, within), d);
    if (d > 0) {
      EXPECT_EQ(within.b1, brute.id);
      fcl::DistanceResult<S> below(d);
      EXPECT_EQ(distanceShape(*model, X_WM_, *shape, X_WS_, request, below), d);
      EXPECT_EQ(below.o1, nullptr);
      ++apart;
    }
    contacts += static_cast<int>(brute.hits.size());
  }

 private:
  static constexpr bool kDouble = std::is_same_v<S, double>;

  void checkDistance(const Mesh& mesh, const ShapeSpec& spec, const Brute<S>& brute) const {
    for (const bool turned : {false, true}) {
      fcl::DistanceRequest<S> request(true);
      request.gjk_solver_type = solver_;
      request.enable_signed_distance = calls_ % 3 == 0;
      fcl::DistanceResult<S> result;
      const S d = turned ? fcl::distance(s_, X_WS_, m_, X_WM_, request, result)
                         : fcl::distance(m_, X_WM_, s_, X_WS_, request, result);
      EXPECT_EQ(d, result.min_distance);
      EXPECT_EQ(d, static_cast<S>(brute.distance));
      EXPECT_EQ(result.o1, m_);
      EXPECT_EQ(result.o2, s_);
      EXPECT_EQ(result.b2, -1);  // NONE
      if (brute.distance > 0) {
        EXPECT_EQ(result.b1, brute.id);
      } else {
        ASSERT_TRUE(brute.hits.count(static_cast<int>(result.b1)));
      }
      const auto &p = result.nearest_points[0], &q = result.nearest_points[1];
      const double world = (kDouble ? 1e-15 : 1e-6) * (X_WM_.translation().norm() + 10);
      EXPECT_NEAR((p - q).norm(), d, world);
      EXPECT_LE(distanceToTriangle(p.template cast<double>(), X_WM_.template cast<double>(), mesh,
                                   result.b1),
                world);
      const ExactPoint on_shape =
          inShape(q.template cast<Real>() - X_WS_.translation().template cast<Real>());
      EXPECT_LE(std::abs(static_cast<double>(std::max(Real(0), level(spec, on_shape, true)))),
                2 * world);
    }
  }

  void checkContacts(const Mesh& mesh, const ShapeSpec& spec, const Brute<S>& brute) const {
    const std::vector<int> all(brute.hits.begin(), brute.hits.end());
    for (const bool enable_contact : {false, true}) {
      for (const std::size_t most : {std::size_t{1}, std::size_t{3}, kAllContacts}) {
        fcl::CollisionRequest<S> request(most, enable_contact);
        request.gjk_solver_type = solver_;
        fcl::CollisionResult<S> result, turned;
        EXPECT_EQ(fcl::collide(m_, X_WM_, s_, X_WS_, request, result), std::min(most, all.size()));
        fcl::collide(s_, X_WS_, m_, X_WM_, request, turned);
        const std::vector<int> ids = contactsOf(result);
        EXPECT_EQ(contactsOf(turned), ids);
        EXPECT_TRUE(most < kAllContacts || ids == all);
        for (std::size_t c = 0; c < ids.size(); ++c) {
          EXPECT_TRUE(brute.hits.count(ids[c]));
          EXPECT_EQ(turned.getContact(c).o1, m_);
          EXPECT_EQ(result.getContact(c).o1, m_);
          EXPECT_EQ(result.getContact(c).o2, s_);
          EXPECT_EQ(result.getContact(c).b2, -1);  // NONE
        }
        if (!enable_contact || most > 3 || calls_ % 5 != 0) continue;  // a slow oracle
        for (std::size_t c = 0; c < ids.size(); ++c) {
          expectWayOut(result.getContact(c), mesh, spec);
        }
      }
    }
  }
  /// Moving the triangle out along the normal ends the overlap.
  void expectWayOut(const fcl::Contact<S>& contact, const Mesh& mesh, const ShapeSpec& spec) const {
    EXPECT_NEAR(contact.normal.norm(), 1, 1e-6);
    EXPECT_GE(contact.penetration_depth, 0);
    ExactTriangle moved;
    const auto t = corners(mesh, contact.b1);
    for (std::size_t k = 0; k < 3; ++k) {
      moved[k] = inShape(
          X_WM_.linear().template cast<Real>() * t[k].template cast<Real>() +
          (X_WM_.translation() - contact.normal * contact.penetration_depth).template cast<Real>() -
          X_WS_.translation().template cast<Real>());
    }
    const double size = scenes::extent(mesh) + spec.size.norm();
    const double rounding = double{std::numeric_limits<S>::epsilon() * X_WM_.translation().norm()};
    EXPECT_GE(static_cast<double>(leastLevel(spec, moved, false)),
              -(kDouble ? 1e-8 : 1e-5) * size - rounding);
    if (spec.kind == Shape::kHalfspace) return;
    EXPECT_LE(distanceToTriangle(contact.pos.template cast<double>(), X_WM_.template cast<double>(),
                                 mesh, contact.b1),
              (kDouble ? 1e-12 : 1e-5) + rounding);
  }
  ExactPoint inShape(const ExactPoint& x) const {
    return X_WS_.linear().template cast<Real>().transpose() * x;
  }

  const fcl::CollisionGeometry<S>*m_ = nullptr, *s_ = nullptr;
  fcl::Transform3<S> X_WM_, X_WS_;
  fcl::GJKSolverType solver_ = fcl::GST_LIBCCD;
  int calls_ = 0;
};

template <typename S>
void compareAll(Shape kind) {
  Compare<S> compare;
  scenes::Random random(29);
  const Mesh box = scenes::subdividedBox({1, 1, 1}, 4);
  for (const Mesh& mesh :
       {scenes::bumpyTorus(300), scenes::randomSoup(60, 1, 1e-2, 1, 3), box, scenes::soup(box)}) {
    for (const Frame& frame : randomFrames(24, 1.6, 3)) {
      compare(mesh, randomShape(kind, random), frame.X_WA, frame.X_WB);
    }
    if (sizeof(S) == sizeof(double)) {
      for (const Frame& frame : randomFrames(4, 2, 7, Vector3d(1e9, -1e9, 3e8))) {
        compare(mesh, randomShape(kind, random), frame.X_WA, frame.X_WB);
      }
    }
    // Faces and edges parallel to the shape's axes: many features are as near.
    for (int i = 0; i < 16; ++i) {
      ShapeSpec spec = randomShape(kind, random);
      fcl::Transform3d X = fcl::Transform3d::Identity(), turned = X;
      X.translation() = Vector3d(0.25 * (i % 3), 0.25 * (i % 2), i < 12 ? 1.75 : 0.5);
      if (i % 2 == 1) turned.linear() << 0, -1, 0, 0, 0, 1, -1, 0, 0;
      compare(mesh, spec, X, turned);
    }
  }
  EXPECT_GT(compare.apart, 10);
  EXPECT_GT(compare.contacts, 10);
}

class Queries : public ::testing::TestWithParam<Shape> {};

TEST_P(Queries, EqualBruteForceInDouble) { compareAll<double>(GetParam()); }
TEST_P(Queries, EqualBruteForceInFloat) { compareAll<float>(GetParam()); }

// Solver objects as arguments change nothing.
TEST_P(Queries, SolversAsArguments) {
  scenes::Random random(3);
  const auto model = kiosModel(scenes::bumpyTorus(160));
  const auto shape = makeShape<double>(randomShape(GetParam(), random));
  const fcl::CollisionGeometryd *m = model.get(), *s = shape.get();
  const auto [X, Y] = randomFrames(1, 1, 4).front();
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

// What dips a little into a body's flat side, or all but touches it, as the body's box tells.
TEST(RoundedShapes, DipIntoBoxes) {
  scenes::Random random(43);
  int met = 0, missed = 0;
  const auto turns = scenes::randomPoses(600, 1, 53);
  std::size_t turn = 0;
  const Mesh thin = scenes::subdividedBox({1.5, 1, 0.02}, 6), slab = scenes::sheet(2, 2, 12, 12, 0);
  for (const Mesh& mesh : {thin, slab}) {
    const auto model = kiosModel(mesh);
    for (const fcl::Transform3d& X_WM : scenes::randomPoses(300, 3, 47)) {
      const double r = random.uniform(0.05, 0.5), length = random.uniform(0, 0.5);
      const bool ball = random.unit() < 0.5;
      std::shared_ptr<fcl::CollisionGeometryd> shape = std::make_shared<fcl::Sphered>(r);
      if (!ball) shape = std::make_shared<fcl::Capsuled>(r, length);
      fcl::Transform3d X_MS = fcl::Transform3d::Identity();
      X_MS.linear() = turns[turn++].linear();
      const double reach = ball ? r : r + 0.5 * length * std::abs(X_MS.linear()(2, 2));
      const double dip = r * std::pow(10, random.uniform(-8, -0.3));
      const double top = mesh.vertices.size() == thin.vertices.size() ? 0.01 : 0.0;
      for (const double gap : {-dip, dip}) {
        X_MS.translation() =
            Vector3d(random.uniform(-0.3, 0.3), random.uniform(-0.3, 0.3), top + reach + gap);
        fcl::CollisionResultd result;
        collideShape(*model, X_WM, *shape, fcl::Transform3d(X_WM * X_MS), fcl::CollisionRequestd(),
                     result);
        (gap < 0 ? met : missed) += result.isCollision() == (gap < 0);
      }
    }
  }
  EXPECT_EQ(met, 600);
  EXPECT_EQ(missed, 600);
}

// Around the vertex or along the edge of a mesh that is nearest, all triangles are as near,
// bitwise, and the least id is named.
TEST_P(Queries, TheLeastIdAroundAVertexIsNamed) {
  if (GetParam() >= Shape::kConvex) return;  // by GJK, triangle by triangle; or tilted
  const Mesh ball = scenes::icosphere(1, 2);
  scenes::Random random(31);
  int around = 0;
  for (std::size_t v = 0; v < ball.vertices.size(); v += 5) {
    const auto shape = makeShape<double>(randomShape(GetParam(), random));
    // The vertex on top: the nearest to what lies above it.
    const Vector3d up = ball.vertices[v].normalized();
    fcl::Transform3d X = fcl::Transform3d::Identity();
    X.linear() = Eigen::Quaterniond::FromTwoVectors(up, -Vector3d::UnitZ()).toRotationMatrix();
    X.translation().z() = 3;
    const auto model = kiosModel(ball);
    fcl::DistanceResultd result;
    distanceShape(*model, X, *shape, fcl::Transform3d::Identity(), fcl::DistanceRequestd(true),
                  result);
    int least = -1;
    for (int t = static_cast<int>(ball.triangles.size()) - 1; t >= 0; --t) {
      for (int c = 0; c < 3; ++c) {
        if (ball.triangles[static_cast<std::size_t>(t)][c] == v) least = t;
      }
    }
    if ((X * ball.vertices[v] - result.nearest_points[0]).norm() > 1e-12) continue;
    EXPECT_EQ(result.b1, least);
    ++around;
  }
  EXPECT_GT(around, 10);
}

// Hulls of many points, in any order, are searched by slabs that are found on the way.
template <typename S>
void compareManyFaced() {
  Compare<S> compare;
  scenes::Random random(37);
  std::mt19937_64 order(38);
  for (const Mesh& ball :
       {scenes::icosphere(1, 2), scenes::icosphere(1, 3), scenes::stripCylinder(60, 1, 0.02)}) {
    for (const Mesh& mesh : {scenes::bumpyTorus(300), scenes::subdividedBox({2, 2, 0.2}, 1)}) {
      for (const Frame& frame : randomFrames(6, 1.6, 5)) {
        ShapeSpec spec = randomShape(Shape::kConvex, random);
        std::vector<std::size_t> place(ball.vertices.size());
        std::iota(place.begin(), place.end(), std::size_t{0});
        std::shuffle(place.begin(), place.end(), order);
        spec.hull = ball;
        for (std::size_t i = 0; i < place.size(); ++i) {
          spec.hull.vertices[place[i]] =
              ball.vertices[i].cwiseProduct(spec.size).cast<float>().cast<double>();
        }
        for (auto& t : spec.hull.triangles) t.set(place[t[0]], place[t[1]], place[t[2]]);
        compare(mesh, spec, frame.X_WA, frame.X_WB);
      }
    }
  }
  EXPECT_GT(compare.apart, 10);
  EXPECT_GT(compare.contacts, 100);
}

TEST(ManyFacedHulls, AnswerAsBruteForce) { compareManyFaced<double>(); }
TEST(ManyFacedHulls, AnswerAsBruteForceInFloat) { compareManyFaced<float>(); }

INSTANTIATE_TEST_SUITE_P(Shapes, Queries, ::testing::ValuesIn(kShapes), NameOfShape());

}  // namespace
}  // namespace kios::testing
