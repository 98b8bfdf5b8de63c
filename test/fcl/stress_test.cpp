// SPDX-FileCopyrightText: 2026 The fcl_kios authors
// SPDX-License-Identifier: BSD-3-Clause

// fcl::distance and fcl::collide over meshes made of the hard classes of triangles, freshly built
// and after every kind of refit, against the triangle kernels run over all pairs. The kernels
// themselves are judged in test/triangle.

#include <algorithm>
#include <cmath>
#include <set>
#include <vector>

#include <gtest/gtest.h>

#include "fcl_kios/fcl_kios.h"
#include "scenes/random.h"
#include "scenes/triangle_classes.h"

namespace kios::testing {
namespace {

using PairSet = std::set<std::pair<int, int>>;

struct SoupPair {
  std::vector<Vector3d> a, b;  // three a triangle
};

/// Returns the first triangles of `count` pairs of a class, and the second ones, as two soups.
SoupPair soups(std::size_t class_index, std::size_t count, std::uint64_t seed) {
  SoupPair soups;
  for (const auto& pair : scenes::trianglePairs(class_index, count, seed)) {
    soups.a.insert(soups.a.end(), pair.a.begin(), pair.a.end());
    soups.b.insert(soups.b.end(), pair.b.begin(), pair.b.end());
  }
  return soups;
}

std::shared_ptr<Modeld> modelOf(const std::vector<Vector3d>& corners) {
  std::vector<fcl::Triangle> triangles;
  for (std::size_t i = 0; i < corners.size(); i += 3) triangles.emplace_back(i, i + 1, i + 2);
  return makeModel<double>(corners, triangles);
}

struct BruteForce {
  double distance = std::numeric_limits<double>::max();
  double extent = 0;  // of everything, in the common frame
  PairSet hits;
};

BruteForce bruteForce(const Modeld& a, const Transform3d& X_WA, const Modeld& b,
                      const Transform3d& X_WB) {
  BruteForce result;
  const RelativePose<double> X_AB(X_WA, X_WB);
  Vector3d low = a.vertices[0], high = low;
  const auto triangle = [&](const Modeld& m, int i, const auto& X) {
    TriangleVertices<double> t;
    for (int c = 0; c < 3; ++c) {
      t[c] = X * m.vertices[m.tri_indices[i][c]];
      low = low.cwiseMin(t[c]);
      high = high.cwiseMax(t[c]);
    }
    return t;
  };
  for (int i = 0; i < a.num_tris; ++i) {
    const auto p = triangle(a, i, Transform3d::Identity());
    for (int j = 0; j < b.num_tris; ++j) {
      const auto q = triangle(b, j, X_AB);
      result.distance = std::min(result.distance, triangleDistance(p, q).distance);
      if (trianglesIntersect(p, q)) result.hits.emplace(i, j);
    }
  }
  result.extent = (high - low).stableNorm();
  return result;
}

void expectBruteForce(const std::shared_ptr<Modeld>& a, const Transform3d& X_WA,
                      const std::shared_ptr<Modeld>& b, const Transform3d& X_WB) {
  const BruteForce expected = bruteForce(*a, X_WA, *b, X_WB);
  fcl::DistanceResultd nearest;
  const double d = fcl::distance(a.get(), X_WA, b.get(), X_WB, fcl::DistanceRequestd(), nearest);
  EXPECT_EQ(d == 0, expected.distance == 0);
  // Bounds are exact to rounding, the kernel to 16 eps: a pruned pair may be that much nearer.
  EXPECT_NEAR(d, expected.distance, 32 * 0x1p-52 * expected.extent);

  fcl::CollisionResultd contacts;
  const fcl::CollisionRequestd request(std::numeric_limits<std::size_t>::max(), true);
  fcl::collide(a.get(), X_WA, b.get(), X_WB, request, contacts);
  PairSet hits;
  for (std::size_t i = 0; i < contacts.numContacts(); ++i) {
    hits.emplace(contacts.getContact(i).b1, contacts.getContact(i).b2);
    EXPECT_TRUE(contacts.getContact(i).normal.allFinite());
  }
  EXPECT_EQ(hits, expected.hits);
  EXPECT_EQ(d == 0, !hits.empty());
}

class MeshStress : public ::testing::TestWithParam<std::size_t> {};

TEST_P(MeshStress, EqualsBruteForceBeforeAndAfterEveryRefit) {
  SCOPED_TRACE(scenes::triangleClasses()[GetParam()].name);
  const SoupPair shape = soups(GetParam(), 24, 1), moved = soups(GetParam(), 24, 2);
  Transform3d lattice = Transform3d::Identity();  // a pose that rounds nothing
  lattice.linear() << 0, -1, 0, 1, 0, 0, 0, 0, 1;
  Transform3d turned = Transform3d::Identity();
  turned.linear() = Eigen::AngleAxisd(0.7, Vector3d(1, 2, 3).normalized()).toRotationMatrix();

  auto a = modelOf(shape.a), b = modelOf(shape.b);
  const auto check = [&] {
    expectBruteForce(a, Transform3d::Identity(), b, Transform3d::Identity());
    expectBruteForce(b, lattice, a, Transform3d::Identity());
    expectBruteForce(a, turned, b, lattice);
  };
  check();
  for (const bool bottom_up : {true, false}) {
    a->beginReplaceModel();
    a->replaceSubModel(bottom_up ? moved.a : shape.a);
    a->endReplaceModel(true, bottom_up);
    b->beginUpdateModel();
    b->updateSubModel(bottom_up ? moved.b : shape.b);
    b->endUpdateModel(true, bottom_up);
    check();
    b = modelOf(shape.b);  // an updated model can't be replaced
  }
}

INSTANTIATE_TEST_SUITE_P(Classes, MeshStress,
                         ::testing::Range<std::size_t>(0, scenes::triangleClasses().size()));

}  // namespace
}  // namespace kios::testing
