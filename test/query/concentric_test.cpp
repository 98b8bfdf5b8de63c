// SPDX-FileCopyrightText: 2026 The fcl_kios authors
// SPDX-License-Identifier: BSD-3-Clause
//
// Leaves whose centres nearly coincide: the direction between them is noise of any length, also one
// whose square no float holds, and in any query. Every answer against brute force, also where the
// processor flushes subnormal numbers to 0.

#include <gtest/gtest.h>
#if defined(__x86_64__)
#include <xmmintrin.h>
#endif

#include <cmath>

#include "fcl/mesh_cases.h"
#include "fcl_kios/fcl_kios.h"
#include "query/query_cases.h"
#include "scenes/random.h"

namespace kios::testing {
namespace {

/// Subnormal numbers are 0 while it lives, if the processor can.
class FlushSubnormals {
 public:
#if defined(__x86_64__)
  FlushSubnormals() : before_(_mm_getcsr()) { _mm_setcsr(before_ | 0x8040U); }
  ~FlushSubnormals() { _mm_setcsr(before_); }

 private:
  const unsigned before_;
#else
  ~FlushSubnormals() {}
#endif
};

/// Small triangles within [-size, size]^3, whose box is centred at 0 exactly: coordinates are
/// multiples of 2^-10 of its corners, which are two of the triangles.
Mesh centredSoup(Random& random, int count, double size, double spread) {
  const auto grid = [&](double reach) {
    return std::ldexp(std::round(std::ldexp(random.uniform(-reach, reach), 10)), -10);
  };
  const auto point = [&](double reach) -> Vector3d {
    const double x = grid(reach), y = grid(reach);
    return {x, y, grid(reach)};
  };
  Mesh mesh;
  for (int i = 0; i < count; ++i) {
    const Vector3d c = point(0.8 * spread), p = c + point(0.1), q = c + point(0.1);
    addTriangle(mesh, c, p, q);
  }
  const Vector3d corner = Vector3d::Constant(spread);
  addTriangle(mesh, corner, corner, corner);
  addTriangle(mesh, -corner, -corner, -corner);
  for (Vector3d& p : mesh.vertices) p *= size;
  return mesh;
}

/// Returns five triangles of size `part` on a line of length 2, `offset` from the mesh's origin.
Mesh dashedRod(Random& random, double part, const Vector3d& offset) {
  Mesh mesh;
  const auto add = [&](double x) {
    addTriangle(mesh, {x, 0, 0}, {x + part, part, 0}, {x + part, 0, part});
  };
  add(-1 - part);
  for (const double x : {0.25, -0.25, 0.6}) add(x + random.uniform(-0.2, 0.2));
  add(1);
  for (Vector3d& p : mesh.vertices) p += offset;
  return mesh;
}

/// Everything that has a bound in it, against brute force.
void expectRight(const Mesh& a, const Mesh& b, const Frame& frame, double size) {
  const auto model_a = kiosModel(a), model_b = kiosModel(b);
  const auto& [X_WA, X_WB] = frame;
  const double exact = leafDistance(a, b, frame), slack = 1e-14 * size;

  fcl::DistanceResultd result;
  fcl::distance(model_a.get(), X_WA, model_b.get(), X_WB, fcl::DistanceRequestd(), result);
  EXPECT_NEAR(result.min_distance, exact, slack);
  for (const double rel_err : {0.0, 0.1}) {
    DistanceBracketRequest<double> options;
    options.rel_err = rel_err;
    const auto answer = kios::distanceBracket(*model_a, X_WA, *model_b, X_WB, options);
    EXPECT_LE(answer.lower_bound, exact + slack);
    EXPECT_GE(answer.upper_bound, exact);
    EXPECT_LE(answer.distance, exact * (1 + rel_err) + slack);
  }
  EXPECT_TRUE(closerThan(*model_a, X_WA, *model_b, X_WB, exact * 1.01));
  EXPECT_EQ(closerThan(*model_a, X_WA, *model_b, X_WB, exact * 0.99), exact == 0);

  SceneDistance<double> scene;
  scene.add(model_a, X_WA);
  scene.add(model_b, X_WB);
  EXPECT_EQ(scene.pairsWithin(exact * 1.01).size(), 1u);
  SceneRequest verdict;
  verdict.exact = false;
  scene.forget();
  EXPECT_EQ(scene.pairsWithin(exact * 1.01, verdict).size(), 1u);

  fcl::CollisionResultd contacts;
  fcl::collide(model_a.get(), X_WA, model_b.get(), X_WB, {kAllContacts, true}, contacts);
  EXPECT_EQ(contactPairs(contacts), leafPairs(a, b, frame));
}

void runOffsets() {
  Random random(1);
  for (const double size : {1.0, 0x1p-20, 0x1p-33, 0x1p30}) {
    for (const double offset : {0.0, 1e-16, 1e-19, 1e-20, 1e-22, 1e-25, 1e-30, 1e-40, 1e-60}) {
      for (int i = 0; i < 40; ++i) {
        const Mesh a = centredSoup(random, 4, size, 1), b = centredSoup(random, 2, size, 0.25);
        Frame frame = {Transform3d::Identity(), Transform3d::Identity()};
        frame.X_WB.translation() = offset * size * inCube(random);
        SCOPED_TRACE(::testing::Message() << "size " << size << " offset " << offset << " " << i);
        expectRight(a, b, frame, size);
        if (::testing::Test::HasFailure()) return;
      }
    }
  }
}

void runRods() {
  Random random(2);
  for (const double part : {0.0, 1e-12, 1e-8, 1e-5, 1e-2}) {
    for (const bool posed : {false, true}) {
      for (int i = 0; i < 150; ++i) {
        const Vector3d offset = 5 * inCube(random);
        const Mesh rod = dashedRod(random, part, offset);
        const auto poses = scenes::randomPoses(2, 1, 100 + i);
        const Vector3d centre = offset + Vector3d(0, part / 2, part / 2);
        Frame frame = {Transform3d::Identity(), poses[0]};
        frame.X_WB.translation() = centre - frame.X_WB.linear() * centre;
        if (posed) {
          frame.X_WA = poses[1];
          frame.X_WB = poses[1] * frame.X_WB;
        }
        SCOPED_TRACE(::testing::Message() << "part " << part << " posed " << posed << " " << i);
        expectRight(rod, rod, frame, 1);
        if (::testing::Test::HasFailure()) return;
      }
    }
  }
}

TEST(Concentric, OffsetsOfAnyLength) { runOffsets(); }

TEST(Concentric, RodsTurnedAboutTheirCentre) { runRods(); }

TEST(Concentric, WhereSubnormalsAreFlushed) {
  const FlushSubnormals flush;
  runOffsets();
  runRods();
}

}  // namespace
}  // namespace kios::testing
