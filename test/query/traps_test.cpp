// SPDX-FileCopyrightText: 2026 The fcl_kios authors
// SPDX-License-Identifier: BSD-3-Clause
//
// Queries of meshes raise no floating-point flags, beside those that mesh_fuzz asks, which traps
// them.
#include "floating_point_flags.h"
#include "query/query_cases.h"
#include "scalars.h"

namespace kios::testing {
namespace {

KIOS_SCALAR_SUITE(QueryTraps);

// kios::validate() refuses them, FCL's calls do not.
TYPED_TEST(QueryTraps, VerticesOfNoTriangleMayBeAnything) {
  using S = TypeParam;
  Flags flags;
  const auto modelWith = [](const Mesh& mesh, S unused) {
    auto model = std::make_shared<Model<S>>();
    std::vector<fcl::Vector3<S>> vertices;
    for (const auto& v : mesh.vertices) vertices.push_back(v.template cast<S>());
    vertices.insert(vertices.begin() + 1, fcl::Vector3<S>::Constant(unused));
    std::vector<fcl::Triangle> triangles;
    for (const auto& t : mesh.triangles) {
      const auto at = [](std::size_t i) { return i == 0 ? i : i + 1; };
      triangles.emplace_back(at(t[0]), at(t[1]), at(t[2]));
    }
    model->beginModel();
    model->addSubModel(vertices, triangles);
    EXPECT_EQ(model->endModel(), fcl::BVH_OK);
    return model;
  };
  const fcl::Transform3<S> here = fcl::Transform3<S>::Identity();
  const S infinity = std::numeric_limits<S>::infinity();
  for (const std::size_t size : {1, 2, 3, 4, 12, 30, 80}) {
    const Mesh soup = scenes::randomSoup(static_cast<int>(size), 1, 1, 1, 5);
    for (const S unused : {std::numeric_limits<S>::quiet_NaN(), infinity, -infinity,
                           std::numeric_limits<S>::max()}) {
      const auto a = modelWith(soup, unused), b = modelWith(soup, unused);
      const auto plain = modelOf<S>(soup);
      auto poses = scenes::randomPoses(9, 2, size);
      poses[0].setIdentity();
      poses[1].linear().setIdentity();
      for (const fcl::Transform3d& pose : poses) {
        const fcl::Transform3<S> X = pose.cast<S>();
        const std::string name = std::to_string(size) + ", " + std::to_string(double{unused});
        fcl::DistanceResult<S> distance, expected;
        fcl::CollisionResult<S> contacts, expected_contacts;
        flags.during(name, [&] {
          fcl::distance(a.get(), here, b.get(), X, fcl::DistanceRequest<S>(true), distance);
          fcl::collide(a.get(), here, b.get(), X, fcl::CollisionRequest<S>(1), contacts);
        });
        fcl::distance(plain.get(), here, plain.get(), X, fcl::DistanceRequest<S>(true), expected);
        fcl::collide(plain.get(), here, plain.get(), X, fcl::CollisionRequest<S>(1),
                     expected_contacts);
        EXPECT_EQ(distance.min_distance, expected.min_distance) << name;
        EXPECT_EQ(contacts.numContacts(), expected_contacts.numContacts()) << name;
      }
    }
  }
}

// Products of such coordinates are beyond the scalar's range, or vanish.
TYPED_TEST(QueryTraps, FewTrianglesAtAnyScale) {
  using S = TypeParam;
  Flags flags;
  const int most = sizeof(S) == sizeof(double) ? 990 : 110;
  for (const int size : {1, 2, 4, 12}) {
    const Mesh soup = scenes::randomSoup(size, 0.3, 1, 1, 9);
    for (int k = -most; k <= most; k += 10) {
      const Mesh mesh = scenes::moved(fcl::Transform3d(Eigen::Scaling(std::ldexp(1.0, k))), soup);
      const auto a = modelOf<S>(mesh), b = modelOf<S>(mesh);
      fcl::Transform3<S> X = fcl::Transform3<S>::Identity(), far = X;
      far.translation() = fcl::Vector3<S>(S(std::ldexp(5.0, k)), 0, 0);
      for (const auto* const at : {&X, &far}) {
        flags.during(std::to_string(size) + " at 2^" + std::to_string(k), [&] {
          fcl::DistanceResult<S> distance;
          fcl::CollisionResult<S> contacts;
          fcl::distance(a.get(), X, b.get(), *at, fcl::DistanceRequest<S>(true), distance);
          fcl::collide(a.get(), X, b.get(), *at, fcl::CollisionRequest<S>(3), contacts);
          EXPECT_EQ(contacts.isCollision(), at == &X) << k;
          EXPECT_EQ(distance.min_distance == 0, at == &X) << k;
        });
      }
    }
  }
}

// The squares of such edges are subnormal or 0, and the inverse of a subnormal number is infinite.
TYPED_TEST(QueryTraps, EdgesWithSubnormalSquares) {
  using S = TypeParam;
  Flags flags;
  Random random(8);
  const bool is_float = sizeof(S) == 4;
  const int least = std::numeric_limits<S>::min_exponent / 2 - (is_float ? 14 : 30);
  for (int i = 0; i < 20000; ++i) {
    const S tiny =
        std::ldexp(S(1), least + static_cast<int>(random.uniform(0, is_float ? 20 : 40)));
    TriangleVertices<S> triangles[2];
    for (auto& triangle : triangles) {
      for (auto& v : triangle) {
        for (S& x : v) {
          const double kind = random.uniform(0, 1);
          x = static_cast<S>(random.uniform(-1, 1));
          if (kind < 0.4) x = kind < 0.2 ? S(0) : std::round(x);
        }
      }
      const auto k = static_cast<std::size_t>(random.uniform(0, 3));
      if (random.uniform(0, 1) > 0.8) continue;
      for (const std::size_t corner : {k, (k + 1) % 3}) triangle[corner] *= tiny;
    }
    flags.during("triangleDistance", [&] { triangleDistance<S>(triangles[0], triangles[1]); });
    flags.during("trianglesIntersect", [&] { trianglesIntersect<S>(triangles[0], triangles[1]); });
  }
}

}  // namespace
}  // namespace kios::testing
