// SPDX-FileCopyrightText: 2026 The fcl_kios authors
// SPDX-License-Identifier: BSD-3-Clause
//
// Bodies of few triangles, for which queries have ways of their own: planes between vertices, all
// pairs at once, and walks of FCL's trees as long as nobody has prepared the models. Against all
// pairs, and the engine.

#include <gtest/gtest.h>

#include "query/small_bodies.h"
#include "scalars.h"

namespace kios::testing {
namespace {

/// Returns a model that shares no tree with one of the same mesh.
template <typename S>
std::shared_ptr<Model<S>> another(Mesh mesh) {
  mesh.vertices.push_back(mesh.vertices.at(0));
  const auto model = modelOf<S>(mesh);
  prepare(*model);
  return model;
}

template <typename S>
std::vector<std::pair<int, int>> contactsOf(const Model<S>& a, const Model<S>& b, const Poses<S>& X,
                                            std::size_t limit) {
  fcl::CollisionResult<S> result;
  collideMeshes(a, X.X_WA, b, X.X_WB, fcl::CollisionRequest<S>(limit), result);
  std::vector<std::pair<int, int>> pairs;
  for (std::size_t i = 0; i < result.numContacts(); ++i) {
    const auto& contact = result.getContact(i);
    pairs.emplace_back(static_cast<int>(contact.b1), static_cast<int>(contact.b2));
  }
  return pairs;
}

KIOS_SCALAR_SUITE(SmallBodies);

TYPED_TEST(SmallBodies, ContactsAreThoseOfAllPairs) {
  using S = TypeParam;
  Random random(11);
  int touching = 0, apart = 0;
  for (int i = 0; i < 1500; ++i) {
    const Mesh mesh_a = smallMesh(i, random), mesh_b = smallMesh(i / 8, random);
    const auto a = modelOf<S>(mesh_a), b = modelOf<S>(mesh_b);
    const auto X = poseAt<S>(i, random.uniform(0, 1.5), random);
    const AllPairs all = allPairs(*a, *b, X);
    const auto one = contactsOf(*a, *b, X, 1);
    ASSERT_EQ(one.empty(), all.hits.empty()) << i;
    if (!one.empty()) {
      ASSERT_TRUE(std::find(all.hits.begin(), all.hits.end(), one[0]) != all.hits.end()) << i;
    }
    ASSERT_EQ(contactsOf(*a, *b, X, 100000), all.hits) << i;
    ASSERT_EQ(contactsOf(*a, *b, X, 2).size(), std::min<std::size_t>(2, all.hits.size())) << i;
    (all.hits.empty() ? apart : touching) += 1;
  }
  EXPECT_GT(touching, 300);
  EXPECT_GT(apart, 300);
}

// Models are prepared on the way, and no answer changes.
TYPED_TEST(SmallBodies, AnswersStayAsModelsGetPrepared) {
  using S = TypeParam;
  Random random(15);
  int prepared = 0, touching = 0;
  for (int i = 0; i < 400; ++i) {
    const auto a = modelOf<S>(smallMesh(i, random)), b = modelOf<S>(smallMesh(i / 8, random));
    const auto X = poseAt<S>(i, random.uniform(0, 1.5), random);
    const auto nearest = [&](bool points) {
      fcl::DistanceResult<S> result;
      distanceMeshes(*a, X.X_WA, *b, X.X_WB, fcl::DistanceRequest<S>(points), result);
      return result;
    };
    const auto distance = nearest(true);
    const auto one = contactsOf(*a, *b, X, 1), two = contactsOf(*a, *b, X, 2),
               all = contactsOf(*a, *b, X, 100000);
    for (int k = 0; k < 40; ++k) contactsOf(*a, *b, X, 1);
    const auto again = nearest(true);
    ASSERT_EQ(again.min_distance, distance.min_distance) << i;
    ASSERT_EQ(nearest(false).min_distance, distance.min_distance) << i;
    ASSERT_EQ(std::make_pair(again.b1, again.b2), std::make_pair(distance.b1, distance.b2)) << i;
    ASSERT_EQ(again.nearest_points[0], distance.nearest_points[0]) << i;
    ASSERT_EQ(contactsOf(*a, *b, X, 1).empty(), one.empty()) << i;
    ASSERT_EQ(contactsOf(*a, *b, X, 2), two) << i;
    ASSERT_EQ(contactsOf(*a, *b, X, 100000), all) << i;
    prepared += preparedBytes(*a) > 0;
    touching += !one.empty();
  }
  EXPECT_GT(prepared, 100);
  EXPECT_GT(touching, 50);
}

// Bodies moved along a direction to where they just touch, and a few last bits either way: planes
// between vertices must not tell what rounding hides.
TYPED_TEST(SmallBodies, PlanesBetweenVerticesTellNothingThatRoundingHides) {
  using S = TypeParam;
  Random random(13);
  int touching = 0, apart = 0;
  for (int i = 0; i < 300; ++i) {
    const auto a = modelOf<S>(smallMesh(i, random)), b = modelOf<S>(smallMesh(i / 8, random));
    Poses<S> X = poseAt<S>(i, 3, random);
    fcl::Vector3<S> along = X.X_WA.translation() - X.X_WB.translation();
    const fcl::Vector3<S> start = X.X_WB.translation();
    double low = 0, high = 1;  // touching at high, if ever
    for (int step = 0; step < 70; ++step) {
      const double middle = (low + high) / 2;
      X.X_WB.translation() = start + static_cast<S>(middle) * along;
      const AllPairs all = allPairs(*a, *b, X);
      (all.hits.empty() ? low : high) = middle;
      const bool touch = !all.hits.empty();
      ASSERT_EQ(!contactsOf(*a, *b, X, 1).empty(), touch) << i << ' ' << step;
      fcl::DistanceResult<S> result;
      // Both distances are right to 16 eps of the triangles' extent.
      const S bound = all.rounded<S>() + 64 * std::numeric_limits<S>::epsilon() * 4;
      result.min_distance = bound;
      distanceMeshes(*a, X.X_WA, *b, X.X_WB, fcl::DistanceRequest<S>(), result);
      ASSERT_LT(result.min_distance, bound) << i << ' ' << step;
      (touch ? touching : apart) += 1;
    }
  }
  EXPECT_GT(touching, 500);
  EXPECT_GT(apart, 500);
}

// Convex bodies that have one vertex in common, and a plane through it between them: heights above
// it are 0 but for rounding.
TEST(SmallBodiesInDouble, OneCommonVertexIsFound) {
  Random random(14);
  for (int i = 0; i < 3000; ++i) {
    const auto size = [&] { return random.uniform(0.1, 1); };
    Mesh a = i % 2 == 0 ? box({size(), size(), size()}) : scenes::icosphere(size(), 0);
    Mesh b = i % 3 == 0 ? box({size(), size(), size()}) : scenes::icosphere(size(), 0);
    const fcl::Vector3d own(random.uniform(-1, 1), random.uniform(-1, 1), random.uniform(-1, 1));
    for (auto& p : a.vertices) p += (i % 5) * own;
    for (auto& p : b.vertices) p += (i % 7) * own;
    Poses<double> X = poseAt<double>(1 + 3 * (i % 10), 1, random);
    const fcl::Vector3d along = X.X_WA.linear().col(0);
    const auto farthest = [](const Mesh& mesh, const fcl::Vector3d& direction) {
      return std::max_element(mesh.vertices.begin(), mesh.vertices.end(),
                              [&](const auto& p, const auto& q) {
                                return p.dot(direction) < q.dot(direction);
                              }) -
             mesh.vertices.begin();
    };
    const auto at_a = static_cast<std::size_t>(farthest(a, X.X_WA.linear().transpose() * along));
    const auto at_b = static_cast<std::size_t>(farthest(b, X.X_WB.linear().transpose() * -along));
    X.X_WB.translation() += X.X_WA * a.vertices[at_a] - X.X_WB * b.vertices[at_b];
    a.vertices[at_a] = RelativePosed(X.X_WA, X.X_WB) * b.vertices[at_b];
    const auto model_a = modelOf<double>(a), model_b = modelOf<double>(b);
    ASSERT_FALSE(contactsOf(*model_a, *model_b, X, 1).empty()) << i;
    fcl::DistanceResult<double> result;
    result.min_distance = std::numeric_limits<double>::min();
    distanceMeshes(*model_a, X.X_WA, *model_b, X.X_WB, fcl::DistanceRequest<double>(), result);
    ASSERT_EQ(result.min_distance, 0) << i;
  }
}

}  // namespace
}  // namespace kios::testing
