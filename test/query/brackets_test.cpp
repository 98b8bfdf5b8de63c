// SPDX-FileCopyrightText: 2026 The fcl_kios authors
// SPDX-License-Identifier: BSD-3-Clause
//
// No bracket misses: kios::distance with random options against the oracle, over every kind of
// mesh, in double and float, by the engine and in FCL's tree.

#include <gtest/gtest.h>

#include "query/query_cases.h"
#include "scenes/cad_shapes.h"

namespace kios::testing {
namespace {

template <typename S>
class Brackets : public ::testing::Test {
 protected:
  /// Queries with random options at random poses, spread by both extents; counts faults.
  void check(const Mesh& mesh_a, const Mesh& mesh_b, bool engine, int poses, double spread,
             std::uint64_t seed) {
    const Mesh a = rounded<S>(mesh_a), b = rounded<S>(mesh_b);
    const double length = std::max(scenes::extent(a), scenes::extent(b));
    const auto model_a = modelOf<S>(a, engine), model_b = modelOf<S>(b, engine);
    const scenes::MeshOracle oracle(a, b);
    Random random(seed);
    WarmStart warm;
    for (const auto& [X_WA, X_WB] : posesOf<S>(a, b, poses, spread * length, seed)) {
      const double exact =
          oracle.distance(X_WA.template cast<double>(), X_WB.template cast<double>());
      for (int i = 0; i < 6; ++i) {
        DistanceOptions<S> options = randomOptions<S>(random, exact, length);
        if (i == 0) options = DistanceOptions<S>();
        if (i % 3 == 2) options.warm_start = &warm;
        const auto answer = kios::distance(*model_a, X_WA, *model_b, X_WB, options);
        const char* const fault = faultOf(answer, options, exact);
        ASSERT_EQ(fault, nullptr) << fault << ": exact " << exact << ", [" << answer.lower_bound
                                  << ", " << answer.distance << "] rel_err " << options.rel_err
                                  << " abs_err " << options.abs_err << " far_enough "
                                  << options.far_enough << " near_enough " << options.near_enough
                                  << " budget " << options.max_expansions << " warm "
                                  << (options.warm_start != nullptr);
      }
    }
  }
};
using Scalars = ::testing::Types<double, float>;
TYPED_TEST_SUITE(Brackets, Scalars);

TYPED_TEST(Brackets, EveryKindOfMesh) {
  const auto meshes = allMeshes<TypeParam>();
  const Mesh torus = scenes::bumpyTorus(300);
  std::uint64_t seed = 1;
  for (const NamedMesh& m : meshes) {
    for (const bool engine : {true, false}) {
      SCOPED_TRACE(m.name + (engine ? "" : ", FCL's tree"));
      this->check(m.mesh, m.mesh, engine, 6, 0.4, ++seed);
      this->check(torus, m.mesh, engine, 4, 0.6, ++seed);
    }
  }
}

TYPED_TEST(Brackets, ConnectedMeshes) {
  using namespace scenes;
  const std::vector<Mesh> meshes = {bumpyTorus(2000), icosphere(1, 3), sheet(2, 1.5, 30, 20, 0.3),
                                    subdividedBox({1, 1.5, 2}, 8), stripCylinder(100, 0.6, 0.004)};
  std::uint64_t seed = 100;
  for (const Mesh& a : meshes) {
    for (const Mesh& b : meshes) {
      for (const bool engine : {true, false}) this->check(a, b, engine, 4, 0.5, ++seed);
    }
  }
}

TYPED_TEST(Brackets, Scales) {
  const Mesh torus = scenes::bumpyTorus(200), soup = scenes::randomSoup(60, 1, 1e-2, 1, 3);
  for (int e = -100; e <= 100; e += 10) {
    SCOPED_TRACE("2^" + std::to_string(e));
    const double scale = std::ldexp(1, e);
    const fcl::Vector3d zero = fcl::Vector3d::Zero();
    this->check(transformed(torus, scale, zero), transformed(soup, scale, zero), true, 6, 0.5, 7);
    // They are of very different size.
    this->check(transformed(torus, scale, zero), transformed(soup, 1e-3 * scale, zero), true, 4,
                0.3, 8);
  }
}

// Edges and faces that are parallel, square to each other or coplanar, to the last bit.
TYPED_TEST(Brackets, Parallel) {
  using S = TypeParam;
  const Mesh grid = lattice(6, 0.25), box = scenes::subdividedBox({1, 1, 1}, 4);
  Random random(9);
  for (const Mesh* a : {&grid, &box}) {
    for (const Mesh* b : {&grid, &box}) {
      for (const bool engine : {true, false}) {
        const auto model_a = modelOf<S>(*a, engine), model_b = modelOf<S>(*b, engine);
        const scenes::MeshOracle oracle(*a, *b);
        for (int i = 0; i < 12; ++i) {
          fcl::Transform3d X = fcl::Transform3d::Identity();
          const auto eighth = [&random] { return std::floor(random.uniform(-16, 16)) / 8; };
          for (int k = 0; k < 3; ++k) X.translation()[k] = eighth();
          const double exact = oracle.distance(fcl::Transform3d::Identity(), X);
          for (int k = 0; k < 6; ++k) {
            const auto options = k == 0 ? DistanceOptions<S>() : randomOptions<S>(random, exact, 1);
            const auto answer = kios::distance(*model_a, fcl::Transform3<S>::Identity(), *model_b,
                                               X.cast<S>(), options);
            const char* const fault = faultOf(answer, options, exact);
            ASSERT_EQ(fault, nullptr) << fault << " at " << X.translation().transpose();
          }
        }
      }
    }
  }
}

// Far from the world's origin, rotations off by 1e-6, the generated motions of the benchmarks.
TYPED_TEST(Brackets, Motions) {
  using S = TypeParam;
  const Mesh a = rounded<S>(scenes::bentTorus()), b = rounded<S>(scenes::knobbyTorus());
  const auto model_a = modelOf<S>(a), model_b = modelOf<S>(b);
  const scenes::MeshOracle oracle(a, b);
  Random random(10);
  for (const double offset : {0.0, 1e3, 1073741824.0}) {
    if (sizeof(S) == sizeof(float) && offset > 1e3) continue;
    for (Frame& f : scenes::fallingMotion(60)) {
      f.X_WA.translation().x() += offset;
      f.X_WB.translation().x() += offset;
      f.X_WA.linear()(0, 1) += 1e-6;
      const fcl::Transform3<S> X_WA = f.X_WA.template cast<S>(), X_WB = f.X_WB.template cast<S>();
      const double exact =
          oracle.distance(X_WA.template cast<double>(), X_WB.template cast<double>());
      for (int i = 0; i < 8; ++i) {
        const auto options = i == 0 ? DistanceOptions<S>() : randomOptions<S>(random, exact, 1);
        const auto answer = kios::distance(*model_a, X_WA, *model_b, X_WB, options);
        const char* const fault = faultOf(answer, options, exact);
        ASSERT_EQ(fault, nullptr) << fault << ": exact " << exact << ", [" << answer.lower_bound
                                  << ", " << answer.distance << "] offset " << offset;
        ASSERT_EQ(answer.counts.tree_searches, 0);
      }
    }
  }
}

}  // namespace
}  // namespace kios::testing
