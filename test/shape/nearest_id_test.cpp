// SPDX-FileCopyrightText: 2026 The fcl_kios authors
// SPDX-License-Identifier: BSD-3-Clause
//
// The triangle nearest to a shape is the least of those whose computed distances are bitwise the
// least; contacts are those of brute force, in one order.

#include <gtest/gtest.h>

#include <algorithm>
#include <limits>
#include <numeric>
#include <random>
#include <set>

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
    const fcl::Transform3<S> X_WM(X_M.cast<S>()), X_WS(X_S.cast<S>());
    const Brute<S> brute(*model, X_WM, *shape, X_WS);
    for (const std::size_t most : {std::size_t{1}, std::size_t{3}, kAllContacts}) {
      fcl::CollisionResult<S> result;
      collideShape(*model, X_WM, *shape, X_WS, fcl::CollisionRequest<S>(most, false), result);
      const std::vector<int> ids = contactsOf(result), all(brute.hits.begin(), brute.hits.end());
      EXPECT_EQ(ids.size(), std::min(most, all.size()));
      EXPECT_TRUE(most < kAllContacts || ids == all);
      for (const int id : ids) EXPECT_TRUE(brute.hits.count(id));
    }
    fcl::DistanceResult<S> result;
    const fcl::DistanceRequest<S> request(true);
    const S d = distanceShape(*model, X_WM, *shape, X_WS, request, result);
    EXPECT_EQ(d, static_cast<S>(brute.distance));
    if (brute.distance > 0) {
      EXPECT_EQ(result.b1, brute.id);
      ++apart;
    } else {
      EXPECT_TRUE(brute.hits.count(static_cast<int>(result.b1)));
    }
    fcl::DistanceResult<S> within(static_cast<S>(std::nextafter(d, 2 * d)));
    EXPECT_EQ(distanceShape(*model, X_WM, *shape, X_WS, request, within), d);
    if (d > 0) {
      EXPECT_EQ(within.b1, brute.id);
      fcl::DistanceResult<S> below(d);
      EXPECT_EQ(distanceShape(*model, X_WM, *shape, X_WS, request, below), d);
      EXPECT_EQ(below.o1, nullptr);
    }
    contacts += static_cast<int>(brute.hits.size());
  }
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

class NearestId : public ::testing::TestWithParam<Shape> {};
TEST_P(NearestId, IsThatOfBruteForce) { compareAll<double>(GetParam()); }
TEST_P(NearestId, IsThatOfBruteForceInFloat) { compareAll<float>(GetParam()); }

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
TEST_P(NearestId, IsTheLeastAroundAVertex) {
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

INSTANTIATE_TEST_SUITE_P(Shapes, NearestId, ::testing::ValuesIn(kShapes), NameOfShape());

}  // namespace
}  // namespace kios::testing
