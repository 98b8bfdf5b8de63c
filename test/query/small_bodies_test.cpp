// SPDX-FileCopyrightText: 2026 The fcl_kios authors
// SPDX-License-Identifier: BSD-3-Clause
//
// Bodies of few triangles, for which queries have ways of their own: planes between vertices, all
// pairs at once, and walks of FCL's trees as long as nobody has prepared the models. Against all
// pairs, and the engine.

#include <gtest/gtest.h>

#include "all_pairs.h"
#include "query/query_cases.h"
#include "scalars.h"

namespace kios::testing {
namespace {

using scenes::Random;

Mesh box(const fcl::Vector3d& size) { return scenes::subdividedBox(size, 1); }

/// Returns soups with needles, segments, points and repeated triangles among their triangles.
Mesh nastySoup(int count, Random& random) {
  Mesh mesh =
      scenes::randomSoup(count, 0.5, 0.05, 1.5, static_cast<std::uint64_t>(random.uniform(0, 1e9)));
  for (std::size_t t = 0; t < mesh.triangles.size(); ++t) {
    const double kind = random.uniform(0, 1);
    fcl::Vector3d* const v = &mesh.vertices[3 * t];
    if (kind < 0.1) v[2] = v[1];
    if (kind < 0.03) v[1] = v[2] = v[0];
    if (kind > 0.9) v[2] = (v[0] + v[1]) / 2;
    if (kind > 0.8 && t > 0) std::copy_n(&mesh.vertices[3 * t - 3], 2, v);
  }
  return mesh;
}

/// Returns corners on a coarse grid, so that faces, edges and vertices meet exactly.
Mesh gridSoup(int count, Random& random) {
  Mesh mesh;
  for (int i = 0; i < 3 * count; ++i) {
    fcl::Vector3d p;
    for (int c = 0; c < 3; ++c) p[c] = 0.25 * std::floor(random.uniform(0, 5));
    mesh.vertices.push_back(p);
  }
  for (int i = 0; i < count; ++i) mesh.triangles.emplace_back(3 * i, 3 * i + 1, 3 * i + 2);
  return mesh;
}

Mesh smallMesh(int kind, Random& random) {
  const auto size = [&] { return random.uniform(0.1, 1); };
  switch (kind % 8) {
    case 0:
      return box({size(), size(), size()});
    case 1:
      return nastySoup(1 + static_cast<int>(random.uniform(0, 32)), random);
    case 2:
      return gridSoup(1 + static_cast<int>(random.uniform(0, 20)), random);
    case 3:
      return scenes::icosphere(size(), static_cast<int>(random.uniform(0, 2)));
    case 4:
      return box({1, 0.5, 0.25});
    case 5:
      return nastySoup(1, random);
    case 6:
      return scenes::sheet(1, 1, 3, 4, 0);
    default:
      return scenes::uvSphere(size(), 6, 10);
  }
}

/// Returns poses in general position, on a grid (faces and edges parallel, or in one plane), and so
/// that the bodies nearly touch; the two together far from the origin, or not.
template <typename S>
Poses<S> poseAt(int kind, double apart, Random& random) {
  const auto seed = static_cast<std::uint64_t>(random.uniform(0, 1e9));
  auto poses = scenes::randomPoses(2, 1, seed);
  if (kind % 3 == 0) {
    for (auto& X : poses) {
      X.linear().setIdentity();
      for (int c = 0; c < 3; ++c) X.translation()[c] = 0.25 * std::floor(random.uniform(-4, 5));
    }
  } else {
    poses[1].translation() = poses[0].translation() + apart * poses[1].translation().normalized();
  }
  if (kind % 5 == 0) {
    const double far = sizeof(S) == sizeof(double) ? 0x1p30 : 0x1p10;
    for (auto& X : poses) X.translation() += fcl::Vector3d(far, -far, far / 2);
  }
  return {poses[0].cast<S>(), poses[1].cast<S>()};
}

template <typename S>
AllPairs<S> allPairs(const Model<S>& a, const Model<S>& b, const Poses<S>& X) {
  return {trianglesOf(a), trianglesOf(b), RelativePose<S>(X.X_WA, X.X_WB)};
}

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
    const AllPairs<S> all = allPairs(*a, *b, X);
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

// What a fresh model answers is what the prepared one does: bit for bit where the pair is apart.
TYPED_TEST(SmallBodies, FreshModelsAnswerAsPreparedOnes) {
  using S = TypeParam;
  Random random(12);
  int walks = 0, apart = 0;
  for (int i = 0; i < 1500; ++i) {
    const Mesh mesh_a = smallMesh(i, random), mesh_b = smallMesh(i / 8, random);
    const auto a = modelOf<S>(mesh_a), b = modelOf<S>(mesh_b);
    const auto ready_a = another<S>(mesh_a), ready_b = another<S>(mesh_b);
    const auto X = poseAt<S>(i, random.uniform(0, 3), random);
    const fcl::DistanceRequest<S> request(true);
    SearchCounts by_walk, by_engine;
    fcl::DistanceResult<S> fresh, ready;
    const S d = distanceMeshes(*a, X.X_WA, *b, X.X_WB, request, fresh, &by_walk);
    ASSERT_EQ(d, distanceMeshes(*ready_a, X.X_WA, *ready_b, X.X_WB, request, ready, &by_engine))
        << i << ' ' << fresh.b1 << ' ' << fresh.b2 << ' ' << ready.b1 << ' ' << ready.b2;
    const AllPairs<S> all = allPairs(*a, *b, X);
    ASSERT_EQ(d == 0, !all.hits.empty()) << i;
    ASSERT_LE(std::abs(d - all.distance), 1e-5 * (d + 4)) << i;
    walks += by_walk.expansions == 0 && by_walk.leaf_pairs > 0;
    const int pairs = a->num_tris * b->num_tris;
    if (d == 0 && pairs > 1) {
      ASSERT_EQ(std::make_pair(fresh.b1, fresh.b2), std::make_pair(ready.b1, ready.b2)) << i;
    }
    if (d == 0 && std::max(a->num_tris, b->num_tris) <= 32 && pairs <= 512) {
      ASSERT_EQ(std::make_pair(static_cast<int>(fresh.b1), static_cast<int>(fresh.b2)), all.hits[0])
          << i;
    }
    if (d == 0) continue;
    ++apart;
    ASSERT_EQ(std::make_pair(fresh.b1, fresh.b2), std::make_pair(ready.b1, ready.b2)) << i;
    ASSERT_EQ(fresh.nearest_points[0], ready.nearest_points[0]) << i;
    ASSERT_EQ(fresh.nearest_points[1], ready.nearest_points[1]) << i;
    // Bounds on either side of the distance, as FCL's managers give them.
    for (const double factor : {0.5, 0.999, 1.0, 1.001, 2.0}) {
      const auto c = modelOf<S>(mesh_a), e = modelOf<S>(mesh_b);
      fcl::DistanceResult<S> bounded, bounded_ready;
      bounded.min_distance = bounded_ready.min_distance = static_cast<S>(factor * double{d});
      distanceMeshes(*c, X.X_WA, *e, X.X_WB, request, bounded);
      distanceMeshes(*ready_a, X.X_WA, *ready_b, X.X_WB, request, bounded_ready);
      ASSERT_EQ(bounded.min_distance, std::min(d, static_cast<S>(factor * double{d}))) << i;
      ASSERT_EQ(bounded_ready.min_distance, bounded.min_distance) << i;
      ASSERT_EQ(bounded.b1, bounded_ready.b1) << i;
      ASSERT_EQ(bounded.b2, bounded_ready.b2) << i;
    }
  }
  EXPECT_GT(walks, 500);
  EXPECT_GT(apart, 500);
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

/// Returns one to four triangles: soups, or ones that share vertices, in one plane or not.
Mesh fewTriangles(int count, Random& random) {
  const double kind = random.uniform(0, 1);
  Mesh mesh;
  if (kind < 0.25) {
    mesh = nastySoup(count, random);
  } else if (kind < 0.4) {
    mesh = gridSoup(count, random);
  } else {  // a fan about vertex 0
    const double height = kind < 0.8 ? 0 : random.uniform(-1, 1);
    mesh.vertices.emplace_back(0, 0, height);
    for (int i = 0; i <= count; ++i) {
      const double angle = 1.5 * i;
      mesh.vertices.emplace_back(std::cos(angle), random.uniform(0.5, 1) * std::sin(angle), 0);
    }
    for (int i = 1; i <= count; ++i) mesh.triangles.emplace_back(0, i, i + 1);
  }
  // Coordinates of their own frame may be far larger than the triangles.
  const double far = random.uniform(0, 1) < 0.3 ? random.uniform(-1e4, 1e4) : 0;
  for (auto& p : mesh.vertices) p += fcl::Vector3d(far, -far, far / 3);
  return mesh;
}

// Slabs leave out pairs that are as near but for rounding: the distance stays within the contract,
// and is that of the triangles that are named, whoever asks, at any scale.
TYPED_TEST(SmallBodies, PairByPairTheyAreAsNearAsAllPairsTell) {
  using S = TypeParam;
  constexpr double kEps = std::numeric_limits<S>::epsilon();
  Random random(16);
  int apart = 0, touching = 0, other = 0;
  for (int i = 0; i < 20000; ++i) {
    const int most = i % 2 == 0 ? 4 : 24;
    const int num_a = 1 + i / 2 % most, num_b = 1 + i / 2 / most % (most / num_a);
    Mesh mesh_a = fewTriangles(num_a, random), mesh_b = fewTriangles(num_b, random);
    auto X = poseAt<double>(5 * i + 1 + i % 3, std::pow(10, random.uniform(-5, 1)), random);
    // Their own frames' origins lie where the bodies are not.
    X.X_WA.translation() -= X.X_WA.linear() * mesh_a.vertices[0];
    X.X_WB.translation() -= X.X_WB.linear() * mesh_b.vertices[0];
    const int range = i % 4 != 0 ? 0 : (sizeof(S) == sizeof(double) ? 900 : 60);
    const double scale = std::ldexp(1.0, static_cast<int>(random.uniform(-range, range)));
    for (auto* mesh : {&mesh_a, &mesh_b}) {
      for (auto& p : mesh->vertices) p *= scale;
    }
    for (auto* pose : {&X.X_WA, &X.X_WB}) pose->translation() *= scale;
    const Poses<S> XS = {X.X_WA.template cast<S>(), X.X_WB.template cast<S>()};
    const auto a = modelOf<S>(mesh_a, range == 0), b = modelOf<S>(mesh_b, range == 0);
    const AllPairs<S> all = allPairs(*a, *b, XS);
    const auto ask = [&](bool points) {
      fcl::DistanceResult<S> result;
      distanceMeshes(*a, XS.X_WA, *b, XS.X_WB, fcl::DistanceRequest<S>(points), result);
      return result;
    };
    const auto found = ask(true);
    const S d = found.min_distance;
    ASSERT_EQ(d == 0, !all.hits.empty()) << i;
    const std::pair<int, int> ids = {found.b1, found.b2};
    if (d == 0) {
      ++touching;
      ASSERT_EQ(ids, all.hits[0]) << i;
    } else {
      ++apart;
      ASSERT_GE(d, all.distance) << i;
      ASSERT_LE(double{d} - double{all.distance}, 16 * kEps * all.extent) << i;
      other += ids != all.nearest;
      const auto corners = trianglesOf(*b)[static_cast<std::size_t>(ids.second)];
      const RelativePose<S> X_AB(XS.X_WA, XS.X_WB);
      ASSERT_EQ(d, triangleDistance(trianglesOf(*a)[static_cast<std::size_t>(ids.first)],
                                    {X_AB * corners[0], X_AB * corners[1], X_AB * corners[2]})
                       .distance)
          << i;
    }
    const auto bracket = kios::distance(*a, XS.X_WA, *b, XS.X_WB);
    ASSERT_EQ(bracket.distance, d) << i;
    ASSERT_EQ(std::make_pair(bracket.triangle_a, bracket.triangle_b), ids) << i;
    ASSERT_LE(bracket.lower_bound, all.distance) << i;
    DistanceOptions<S> near;
    near.near_enough = d / 2;
    const auto not_near = kios::distance(*a, XS.X_WA, *b, XS.X_WB, near);
    ASSERT_EQ(not_near.distance, d) << i;
    ASSERT_EQ(not_near.triangle_a, ids.first) << i;
    for (const S more : {S(1), S(1.01), S(1.5)}) {  // as if a pair so far were known
      if (d == 0) break;
      fcl::DistanceResult<S> known;
      known.min_distance = std::nextafter(more * d, std::numeric_limits<S>::infinity());
      distanceMeshes(*a, XS.X_WA, *b, XS.X_WB, fcl::DistanceRequest<S>(false), known);
      ASSERT_EQ(known.min_distance, d) << i;
      ASSERT_EQ(std::make_pair(static_cast<int>(known.b1), static_cast<int>(known.b2)), ids) << i;
    }
    prepare(*a);
    prepare(*b);
    const auto again = ask(true);
    ASSERT_EQ(again.min_distance, d) << i;
    ASSERT_EQ(std::make_pair(static_cast<int>(again.b1), static_cast<int>(again.b2)), ids) << i;
    ASSERT_EQ(again.nearest_points[0], found.nearest_points[0]) << i;
    ASSERT_EQ(again.nearest_points[1], found.nearest_points[1]) << i;
    ASSERT_EQ(ask(false).min_distance, d) << i;
  }
  EXPECT_GT(apart, 5000);
  EXPECT_GT(touching, 1000);
  EXPECT_LT(other, apart / 10) << "pairs that share vertices, some of which differ by rounding";
}

// The triangles of a quad whose common vertex is nearest are as near: the second is left out.
TEST(FewTriangles, OneOfTwoAtACommonVertexIsEvaluated) {
  const auto a = kiosModel(scenes::sheet(1, 1, 1, 1, 0));
  Mesh triangle;
  triangle.vertices = {{2, 3, 1}, {3, 2, 1.5}, {3, 3, 2}};
  triangle.triangles = {{0, 1, 2}};
  const auto b = kiosModel(triangle);
  fcl::Transform3d X_WB = fcl::Transform3d::Identity();
  long long evaluated = 0;
  for (int turn = 0; turn < 4; ++turn) {
    X_WB.linear() = Eigen::AngleAxisd(turn * M_PI / 2, Eigen::Vector3d::UnitZ()).matrix();
    SearchCounts counts;
    fcl::DistanceResultd result;
    distanceMeshes(*a, fcl::Transform3d::Identity(), *b, X_WB, fcl::DistanceRequestd(), result,
                   &counts);
    evaluated += counts.exact;
  }
  EXPECT_LE(evaluated, 5) << "one of the four corners is that of the second triangle alone";
}

// A floor's balls reach high above it: the box of its root tells at once that nothing touches it.
TEST(FewTriangles, PreparedBoxesTellFewTrianglesApart) {
  Mesh floor;
  floor.vertices = {{-5, -5, 0}, {5, -5, 0}, {5, 5, 0}, {-5, 5, 0}};
  floor.triangles = {{0, 1, 2}, {0, 2, 3}};
  const auto a = kiosModel(floor), b = kiosModel(box({0.3, 0.2, 0.15}));
  fcl::Transform3d X_WB = fcl::Transform3d::Identity();
  X_WB.translate(fcl::Vector3d(1, 2, 0.2)).rotate(Eigen::AngleAxisd(0.4, Eigen::Vector3d::UnitX()));
  const auto touch = [&] {
    SearchCounts counts;
    fcl::CollisionResultd result;
    collideMeshes(*a, fcl::Transform3d::Identity(), *b, X_WB, fcl::CollisionRequestd(), result,
                  &counts);
    EXPECT_FALSE(result.isCollision());
    return counts;
  };
  int asked = 0;
  while (preparedBytes(*b) == 0 && asked < 100) {
    touch();
    ++asked;
  }
  EXPECT_GT(asked, 5) << "queries come first";
  EXPECT_LT(asked, 20);
  EXPECT_EQ(touch().exact, 0);
}

TEST(FewTriangles, ThatRootsTellApartPrepareNothingForAnAllowedError) {
  const auto a = kiosModel(scenes::sheet(1, 1, 1, 1, 0)),
             b = kiosModel(scenes::sheet(2, 1, 1, 1, 0));
  fcl::Transform3d X_WB = fcl::Transform3d::Identity();
  X_WB.translation() = fcl::Vector3d(0, 0, 1.5);
  fcl::DistanceRequestd request;
  request.rel_err = 0.1;
  fcl::DistanceResultd result;
  result.min_distance = 0.1;
  EXPECT_EQ(distanceMeshes(*a, fcl::Transform3d::Identity(), *b, X_WB, request, result), 0.1);
  EXPECT_EQ(preparedBytes(*a) + preparedBytes(*b), 0U);
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
      const AllPairs<S> all = allPairs(*a, *b, X);
      (all.hits.empty() ? low : high) = middle;
      const bool touch = !all.hits.empty();
      ASSERT_EQ(!contactsOf(*a, *b, X, 1).empty(), touch) << i << ' ' << step;
      fcl::DistanceResult<S> result;
      // Both distances are right to 16 eps of the triangles' extent.
      const S bound = all.distance + 64 * std::numeric_limits<S>::epsilon() * 4;
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
TYPED_TEST(SmallBodies, OneCommonVertexIsFound) {
  using S = TypeParam;
  using Vec = fcl::Vector3<S>;
  Random random(14);
  for (int i = 0; i < 3000; ++i) {
    const auto size = [&] { return random.uniform(0.1, 1); };
    Mesh a = i % 2 == 0 ? box({size(), size(), size()}) : scenes::icosphere(size(), 0);
    Mesh b = i % 3 == 0 ? box({size(), size(), size()}) : scenes::icosphere(size(), 0);
    const fcl::Vector3d own(random.uniform(-1, 1), random.uniform(-1, 1), random.uniform(-1, 1));
    for (auto& p : a.vertices) p += (i % 5) * own;
    for (auto& p : b.vertices) p += (i % 7) * own;
    a = rounded<S>(a);
    b = rounded<S>(b);
    Poses<S> X = poseAt<S>(1 + 3 * (i % 10), 1, random);
    const fcl::Vector3d along = X.X_WA.linear().col(0).template cast<double>();
    const auto farthest = [](const Mesh& mesh, const fcl::Vector3d& direction) {
      return std::max_element(mesh.vertices.begin(), mesh.vertices.end(),
                              [&](const auto& p, const auto& q) {
                                return p.dot(direction) < q.dot(direction);
                              }) -
             mesh.vertices.begin();
    };
    const fcl::Transform3d X_WA = X.X_WA.template cast<double>(),
                           X_WB = X.X_WB.template cast<double>();
    const auto at_a = static_cast<std::size_t>(farthest(a, X_WA.linear().transpose() * along));
    const auto at_b = static_cast<std::size_t>(farthest(b, X_WB.linear().transpose() * -along));
    X.X_WB.translation() += (X_WA * a.vertices[at_a] - X_WB * b.vertices[at_b]).template cast<S>();
    const Vec common = RelativePose<S>(X.X_WA, X.X_WB) * Vec(b.vertices[at_b].template cast<S>());
    a.vertices[at_a] = common.template cast<double>();
    const auto model_a = modelOf<S>(a), model_b = modelOf<S>(b);
    ASSERT_FALSE(contactsOf(*model_a, *model_b, X, 1).empty()) << i;
    fcl::DistanceResult<S> result;
    result.min_distance = std::numeric_limits<S>::min();
    distanceMeshes(*model_a, X.X_WA, *model_b, X.X_WB, fcl::DistanceRequest<S>(), result);
    ASSERT_EQ(result.min_distance, 0) << i;
  }
}

}  // namespace
}  // namespace kios::testing
