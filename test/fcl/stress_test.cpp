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

#include "fcl/mesh_cases.h"
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

void expectBruteForce(const std::shared_ptr<Modeld>& a, const Transform3d& X_WA,
                      const std::shared_ptr<Modeld>& b, const Transform3d& X_WB) {
  const Triangles triangles_a = trianglesOf(*a), triangles_b = trianglesOf(*b);
  const RelativePose<double> X_AB(X_WA, X_WB);
  const AllPairs expected(triangles_a, triangles_b, X_AB);
  Eigen::AlignedBox3d box;  // of everything, in the common frame
  for (const auto& t : triangles_a) {
    for (const Vector3d& p : t) box.extend(p);
  }
  for (const auto& t : triangles_b) {
    for (const Vector3d& p : t) box.extend(Vector3d(X_AB * p));
  }
  fcl::DistanceResultd nearest;
  const double d = fcl::distance(a.get(), X_WA, b.get(), X_WB, fcl::DistanceRequestd(), nearest);
  EXPECT_EQ(d == 0, expected.distance == 0);
  // Bounds are exact to rounding, the kernel to 16 eps: a pruned pair may be that much nearer.
  EXPECT_NEAR(d, expected.distance, 32 * 0x1p-52 * box.diagonal().stableNorm());

  fcl::CollisionResultd contacts;
  const fcl::CollisionRequestd request(std::numeric_limits<std::size_t>::max(), true);
  fcl::collide(a.get(), X_WA, b.get(), X_WB, request, contacts);
  PairSet hits;
  for (std::size_t i = 0; i < contacts.numContacts(); ++i) {
    hits.emplace(contacts.getContact(i).b1, contacts.getContact(i).b2);
    EXPECT_TRUE(contacts.getContact(i).normal.allFinite());
  }
  EXPECT_EQ(hits, PairSet(expected.hits.begin(), expected.hits.end()));
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
