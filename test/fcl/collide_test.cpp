// SPDX-FileCopyrightText: 2026 The fcl_kios authors
// SPDX-License-Identifier: BSD-3-Clause
//
// fcl::collide of two meshes over k-IOS: verdicts and pairs against the oracle, contacts against
// FCL's own triangle routine and its OBBRSS models.

#include <gtest/gtest.h>

#include <cmath>
#include <map>

#include "fcl/mesh_cases.h"
#include "scenes/random.h"

namespace kios::testing {
namespace {

template <typename Model>
fcl::CollisionResultd query(const Model& a, const Model& b, const Frame& frame,
                            std::size_t max_contacts, bool enable_contact,
                            fcl::GJKSolverType solver = fcl::GST_LIBCCD) {
  fcl::CollisionRequestd request(max_contacts, enable_contact);
  request.gjk_solver_type = solver;
  fcl::CollisionResultd result;
  const std::size_t returned = fcl::collide(&a, frame.X_WA, &b, frame.X_WB, request, result);
  EXPECT_EQ(returned, result.numContacts());
  return result;
}

using PairPoints = std::map<std::pair<int, int>, std::vector<fcl::Contactd>>;

PairPoints byPair(const fcl::CollisionResultd& result) {
  PairPoints points;
  for (std::size_t i = 0; i < result.numContacts(); ++i) {
    const fcl::Contactd& c = result.getContact(i);
    points[{static_cast<int>(c.b1), static_cast<int>(c.b2)}].push_back(c);
  }
  return points;
}

TEST(Collide, PairsAreTheOraclesInBothOrders) {
  for (const MeshCase& pair : meshCases()) {
    SCOPED_TRACE(pair.name);
    const auto model_a = kiosModel(pair.a), model_b = kiosModel(pair.b);
    const scenes::MeshOracle oracle(pair.a, pair.b);
    std::size_t contacts = 0;
    for (const Frame& frame : randomFrames(200, pair.spread, 21)) {
      const Pairs expected = oracle.collidingPairs(frame.X_WA, frame.X_WB);
      contacts += expected.size();
      for (const bool enable_contact : {false, true}) {
        const auto ab = query(*model_a, *model_b, frame, kAllContacts, enable_contact,
                              enable_contact ? fcl::GST_INDEP : fcl::GST_LIBCCD);
        EXPECT_EQ(contactPairs(ab), expected);
        EXPECT_EQ(ab.isCollision(), !expected.empty());
        const auto ba =
            query(*model_b, *model_a, {frame.X_WB, frame.X_WA}, kAllContacts, enable_contact);
        Pairs turned;
        for (const auto& [i, j] : contactPairs(ba)) turned.emplace_back(j, i);
        std::sort(turned.begin(), turned.end());
        EXPECT_EQ(turned, expected);
      }
      EXPECT_EQ(query(*model_a, *model_b, frame, 1, false).isCollision(), !expected.empty());
    }
    EXPECT_GT(contacts, 0u);
  }
}

// Points, normal and depth of each pair are what FCL's triangle routine says, in the world frame;
// a hit without a point counts with one contact.
TEST(Collide, ContactsAreThoseOfFclsTriangleRoutine) {
  for (const MeshCase& pair : meshCases()) {
    SCOPED_TRACE(pair.name);
    const auto model_a = kiosModel(pair.a), model_b = kiosModel(pair.b);
    for (const Frame& frame : randomFrames(100, pair.spread, 23)) {
      const RelativePose<double> X_AB(frame.X_WA, frame.X_WB);
      const auto result = query(*model_a, *model_b, frame, kAllContacts, true);
      for (const auto& [ids, contacts] : byPair(result)) {
        FclContact leaf;
        ASSERT_TRUE(fclContact(pair.a, ids.first, pair.b, ids.second, X_AB, leaf));
        ASSERT_EQ(contacts.size(), std::max(1u, leaf.num_points));
        ASSERT_LE(contacts.size(), 3u);
        for (std::size_t i = 0; i < contacts.size(); ++i) {
          EXPECT_EQ(contacts[i].o1, model_a.get());
          EXPECT_EQ(contacts[i].o2, model_b.get());
          if (leaf.num_points == 0) continue;
          EXPECT_EQ(contacts[i].penetration_depth, std::max(0.0, leaf.depth));
          EXPECT_LE((contacts[i].normal - frame.X_WA.linear() * leaf.normal).norm(), 1e-15);
          EXPECT_LE((contacts[i].pos - frame.X_WA * leaf.points[i]).norm(), 1e-14);
        }
      }
      const auto bare = query(*model_a, *model_b, frame, kAllContacts, false);
      EXPECT_EQ(bare.numContacts(), contactPairs(result).size());  // one a pair
      for (const auto& [ids, contacts] : byPair(bare)) {
        EXPECT_EQ(contacts.front().o1, model_a.get());
        EXPECT_EQ(contacts.front().o2, model_b.get());
      }
    }
  }
}

// A wedge of A dips through the floor B: the normal leads from A to B.
TEST(Collide, NormalsPointFromFirstToSecond) {
  const auto wedge = kiosModel(scenes::singleTriangle({0, 0, -0.1}, {0.5, 0.1, 1}, {-0.5, 0, 1}));
  const auto floor = kiosModel(scenes::singleTriangle({-9, -9, 0}, {9, -9, 0}, {0, 9, 0}));
  const Frame frame{Transform3d::Identity(), Transform3d::Identity()};
  const auto ab = query(*wedge, *floor, frame, kAllContacts, true);
  ASSERT_TRUE(ab.isCollision());
  EXPECT_LE((ab.getContact(0).normal - Vector3d(0, 0, -1)).norm(), 1e-14);
  EXPECT_NEAR(ab.getContact(0).penetration_depth, 0.1, 1e-14);
  const auto ba = query(*floor, *wedge, frame, kAllContacts, true);
  ASSERT_TRUE(ba.isCollision());
  EXPECT_LE((ba.getContact(0).normal - Vector3d(0, 0, 1)).norm(), 1e-14);
}

TEST(Collide, NoContactsAskedForIsFclsWarningAndNone) {
  const auto model = kiosModel(scenes::icosphere(1, 1));
  const Frame same{Transform3d::Identity(), Transform3d::Identity()};
  for (const bool enable_contact : {false, true}) {
    ::testing::internal::CaptureStderr();
    EXPECT_EQ(query(*model, *model, same, 0, enable_contact).numContacts(), 0u);
    EXPECT_NE(::testing::internal::GetCapturedStderr().find("num_max_contact"), std::string::npos);
  }
}

// FCL's convention: contacts add up in a result that is not cleared, up to the limit.
TEST(Collide, ResultsAccumulateUpToTheLimit) {
  const MeshCase pair = meshCases().front();
  const auto model_a = kiosModel(pair.a), model_b = kiosModel(pair.b);
  const Frame same{Transform3d::Identity(), Transform3d::Identity()};
  const auto once = query(*model_a, *model_b, same, kAllContacts, false);
  ASSERT_GT(once.numContacts(), 4u);
  fcl::CollisionResultd result;
  const fcl::CollisionRequestd request(once.numContacts() + 3);
  EXPECT_EQ(fcl::collide(model_a.get(), same.X_WA, model_b.get(), same.X_WB, request, result),
            once.numContacts());
  EXPECT_EQ(fcl::collide(model_a.get(), same.X_WA, model_b.get(), same.X_WB, request, result),
            once.numContacts() + 3);
  EXPECT_EQ(fcl::collide(model_a.get(), same.X_WA, model_b.get(), same.X_WB, request, result),
            once.numContacts() + 3);
}

// FCL's routine squares areas: where that under- or overflows it reads a normal that it never set.
template <typename S>
void expectUnitNormals(double scale) {
  scenes::Random random(31);
  std::vector<fcl::Vector3<S>> vertices[2];
  std::vector<fcl::Triangle> triangles;
  for (std::size_t i = 0; i < 40; ++i) {
    for (auto& list : vertices) {
      for (int k = 0; k < 3; ++k) {
        const double x = random.uniform(-1, 1), y = random.uniform(-1, 1);
        list.push_back((scale * Vector3d(x, y, random.uniform(-1, 1))).cast<S>());
      }
    }
    triangles.emplace_back(3 * i, 3 * i + 1, 3 * i + 2);
  }
  const auto a = makeModel<S>(vertices[0], triangles), b = makeModel<S>(vertices[1], triangles);
  const fcl::Transform3<S> X = fcl::Transform3<S>::Identity();
  fcl::CollisionResult<S> result;
  fcl::collide(a.get(), X, b.get(), X, fcl::CollisionRequest<S>(kAllContacts, true), result);
  EXPECT_GT(result.numContacts(), 20u);
  for (std::size_t i = 0; i < result.numContacts(); ++i) {
    const auto& contact = result.getContact(i);
    EXPECT_NEAR(contact.normal.norm(), 1, 1e-5);
    EXPECT_TRUE(contact.pos.allFinite());
    EXPECT_GE(contact.penetration_depth, 0);
    EXPECT_LE(double{contact.penetration_depth}, 4 * scale);
  }
}

TEST(Collide, NormalsAreUnitVectorsOfAnySize) {
  for (const int exponent : {-300, -260, -20, 0, 20, 200, 300}) {
    expectUnitNormals<double>(std::ldexp(1, exponent));
  }
  for (const int exponent : {-45, -38, -36, -10, 0, 10, 30, 34, 40}) {
    expectUnitNormals<float>(std::ldexp(1, exponent));
  }
}

}  // namespace
}  // namespace kios::testing
