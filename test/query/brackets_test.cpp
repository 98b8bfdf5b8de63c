// SPDX-FileCopyrightText: 2026 The fcl_kios authors
// SPDX-License-Identifier: BSD-3-Clause
//
// No bracket misses: kios::distanceBracket with random options against the oracle, over every kind
// of mesh, in double and float.

#include <gtest/gtest.h>

#include "query/query_cases.h"
#include "scenes/cad_shapes.h"

namespace kios::testing {
namespace {

template <typename S>
class Brackets : public ::testing::Test {
 protected:
  /// Queries with random options at random poses, spread by both extents; counts faults.
  void check(const Mesh& mesh_a, const Mesh& mesh_b, int poses, double spread, std::uint64_t seed) {
    const Mesh a = rounded<S>(mesh_a), b = rounded<S>(mesh_b);
    const double length = std::max(scenes::extent(a), scenes::extent(b));
    const auto model_a = modelOf<S>(a), model_b = modelOf<S>(b);
    const scenes::MeshOracle oracle(a, b);
    Random random(seed);
    WarmStart warm;
    for (const auto& [X_WA, X_WB] : posesOf<S>(a, b, poses, spread * length, seed)) {
      const double exact =
          oracle.distance(X_WA.template cast<double>(), X_WB.template cast<double>());
      for (int i = 0; i < 6; ++i) {
        DistanceBracketRequest<S> options = randomOptions<S>(random, exact, length);
        if (i == 0) options = DistanceBracketRequest<S>();
        if (i % 3 == 2) options.warm_start = &warm;
        const auto answer = kios::distanceBracket(*model_a, X_WA, *model_b, X_WB, options);
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
    SCOPED_TRACE(m.name);
    this->check(m.mesh, m.mesh, 8, 0.4, ++seed);
    this->check(torus, m.mesh, 6, 0.6, ++seed);
  }
}

TYPED_TEST(Brackets, ConnectedMeshes) {
  using namespace scenes;
  const std::vector<Mesh> meshes = {bumpyTorus(2000), icosphere(1, 3), sheet(2, 1.5, 30, 20, 0.3),
                                    subdividedBox({1, 1.5, 2}, 8), stripCylinder(100, 0.6, 0.004)};
  std::uint64_t seed = 100;
  for (const Mesh& a : meshes) {
    for (const Mesh& b : meshes) this->check(a, b, 4, 0.5, ++seed);
  }
}

}  // namespace
}  // namespace kios::testing
