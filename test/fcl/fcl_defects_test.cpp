// SPDX-FileCopyrightText: 2026 The fcl_kios authors
// SPDX-License-Identifier: BSD-3-Clause
//
// Defects of FCL 0.7's own kIOS and of the mesh code around it that our users must not meet. Each
// test runs one check over ours, which passes it, and over FCL's, which fails it: once FCL is
// mended the test says so.

#include <gtest/gtest.h>

#include <fcl/narrowphase/detail/traversal/distance/mesh_distance_traversal_node.h>

#include "fcl/mesh_cases.h"
#include "scenes/random.h"

namespace kios::testing {
namespace {

using FclKios = fcl::kIOSd;
using FclDistanceNode = fcl::detail::MeshDistanceTraversalNodekIOS<double>;
using OurDistanceNode = MeshDistanceTraversalNode<double>;
using fcl::detail::BVSplitter;

// BV tests of a distance query over many poses; errors as FCL's request asks for them.
template <typename BV, typename Node>
long bvTests(const Mesh& a, const Mesh& b, double rel_err) {
  const std::shared_ptr<const fcl::BVHModel<BV>> model_a = scenes::buildModel<BV>(a);
  const std::shared_ptr<const fcl::BVHModel<BV>> model_b = scenes::buildModel<BV>(b);
  long tests = 0;
  for (const Frame& frame : scenes::fallingMotion(50)) {
    fcl::DistanceRequestd request;
    request.rel_err = rel_err;
    fcl::DistanceResultd result;
    Node node;
    initialize(node, *model_a, frame.X_WA, *model_b, frame.X_WB, request, result);
    node.enable_statistics = true;
    fcl::detail::distance<double>(&node);
    tests += node.num_bv_tests;
  }
  return tests;
}

// A volume that is copied for each test, and a bound looser than need be. That nothing is copied
// can't be seen from outside; that the bound is the tighter one shows in the number of tests.
TEST(FclDefect8, LooseDistanceBound) {
  const Mesh a = scenes::bentTorus(), b = scenes::knobbyTorus();
  const long ours = bvTests<kIOSd, OurDistanceNode>(a, b, 0);
  const long theirs = bvTests<FclKios, FclDistanceNode>(a, b, 0);
  EXPECT_LT(1.2 * static_cast<double>(ours), static_cast<double>(theirs));
}

TEST(FclDefect9, BytesOfANode) {
  EXPECT_LE(sizeof(fcl::BVNode<kIOSd>), 128u);
  EXPECT_GT(sizeof(fcl::BVNode<FclKios>), 300u);
}

std::vector<Vector3d> plateCorners() {
  std::vector<Vector3d> points;
  for (int i = 0; i < 8; ++i) {
    points.emplace_back(i & 1 ? 10 : -10, i & 2 ? 1 : -1, i & 4 ? 0.1 : -0.1);
  }
  return points;
}

template <typename BV>
BV fitted(const std::vector<Vector3d>& points) {
  std::vector<Vector3d> copy = points;
  BV bv;
  fit(copy.data(), static_cast<int>(copy.size()), bv);
  return bv;
}

// A cost source's box holds the volume where it is in the world.
template <typename BV>
bool boxIsAtThePose() {
  for (const Transform3d& X : scenes::randomPoses(20, 100, 121)) {
    fcl::Boxd box;
    Transform3d X_box;
    constructBox(fitted<BV>(plateCorners()), X, box, X_box);
    for (const Vector3d& p : plateCorners()) {
      const Vector3d in_box = X_box.inverse(Eigen::Isometry) * (X * p);
      if ((in_box.cwiseAbs() - 0.5 * box.side).maxCoeff() > 1e-9) return false;
    }
  }
  return true;
}

TEST(FclDefect10, ConstructBoxIgnoresThePose) {
  EXPECT_TRUE(boxIsAtThePose<kIOSd>());
  EXPECT_FALSE(boxIsAtThePose<FclKios>());
}

// Volume of the oriented box that a 20 x 2 x 0.2 plate (volume 8) is converted to, which holds it.
template <typename BV>
double convertedVolume(const Transform3d& X) {
  fcl::OBBd obb;
  fcl::AABBd aabb;
  const BV bv = fitted<BV>(plateCorners());
  fcl::convertBV(bv, X, obb);
  fcl::convertBV(bv, X, aabb);
  for (const Vector3d& p : plateCorners()) {
    const Vector3d in_box = obb.axis.transpose() * (X * p - obb.To);
    EXPECT_LE((in_box.cwiseAbs() - obb.extent).maxCoeff(), 1e-9);
    EXPECT_TRUE(aabb.contain(Vector3d(X * p)));
  }
  return obb.volume();
}

TEST(FclDefect11, ConvertedBoxIsACube) {
  for (const Transform3d& X : scenes::randomPoses(20, 10, 122)) {
    EXPECT_LT(convertedVolume<kIOSd>(X), 1000);
    EXPECT_GT(convertedVolume<FclKios>(X), 5000);
  }
}

// Splitting a long bar, off the origin, at the centre of its volume parts it along its length.
template <typename BV>
bool centreSplitPartsTheBar() {
  Mesh bar = scenes::soup(scenes::subdividedBox({1, 30, 1}, 6));
  for (Vector3d& p : bar.vertices) p += Vector3d(0, 100, 0);
  // In an order that says nothing about where the triangles are.
  scenes::Random random(123);
  for (std::size_t i = bar.triangles.size(); i > 1; --i) {
    std::swap(bar.triangles[i - 1], bar.triangles[static_cast<std::size_t>(random.unit() * i)]);
  }
  fcl::BVHModel<BV> model;
  model.bv_splitter.reset(new BVSplitter<BV>(fcl::detail::SPLIT_METHOD_BV_CENTER));
  model.beginModel();
  model.addSubModel(bar.vertices, bar.triangles);
  model.endModel();
  double low = 1e9, high = -1e9;  // of the left child's triangles
  std::vector<int> nodes{model.getBV(0).leftChild()};
  while (!nodes.empty()) {
    const auto& node = model.getBV(nodes.back());
    const int at = nodes.back();
    nodes.pop_back();
    if (node.isLeaf()) {
      for (int corner = 0; corner < 3; ++corner) {
        const double y = model.vertices[model.tri_indices[node.primitiveId()][corner]][1];
        low = std::min(low, y);
        high = std::max(high, y);
      }
    } else {
      nodes.push_back(model.getBV(at).leftChild());
      nodes.push_back(model.getBV(at).rightChild());
    }
  }
  return high - low < 25;
}

TEST(FclDefect12, BvCenterSplitIsNoSplit) {
  EXPECT_TRUE(centreSplitPartsTheBar<kIOSd>());
  EXPECT_FALSE(centreSplitPartsTheBar<FclKios>());
}

TEST(FclDefect13, ErrorBoundsOfTheRequestAreIgnored) {
  const Mesh a = scenes::bentTorus(), b = scenes::knobbyTorus();
  EXPECT_LT((bvTests<kIOSd, OurDistanceNode>(a, b, 0.5)),
            (bvTests<kIOSd, OurDistanceNode>(a, b, 0) * 3 / 4));
  EXPECT_EQ((bvTests<FclKios, FclDistanceNode>(a, b, 0.5)),
            (bvTests<FclKios, FclDistanceNode>(a, b, 0)));
}

// A second query that finds nothing nearer leaves the nearest points where they were.
template <typename BV>
bool reusedResultKeepsItsPoints() {
  const auto model = scenes::buildModel<BV>(scenes::icosphere(1, 1));
  Transform3d X1 = Transform3d::Identity(), X2 = X1, X3 = X1;
  X1.translation() = Vector3d(0, 0, 10);
  X2.translation() = Vector3d(0, 0, 13);
  X3.translation() = Vector3d(0, 0, 20);
  fcl::DistanceResultd result;
  const fcl::DistanceRequestd request(true);
  fcl::distance(model.get(), X1, model.get(), X2, request, result);
  const Vector3d before = result.nearest_points[0];
  fcl::distance(model.get(), X1, model.get(), X3, request, result);
  return result.nearest_points[0] == before;
}

TEST(FclDefect14, ReusedResultIsMovedAgain) {
  EXPECT_TRUE(reusedResultKeepsItsPoints<kIOSd>());
  EXPECT_FALSE(reusedResultKeepsItsPoints<FclKios>());
}

// Results name the caller's models. FCL's kIOS does, too; its RSS models are copied and rebuilt
// for each query, and contacts name the copies, which are gone.
template <typename BV>
bool contactsNameTheModels() {
  const auto a = scenes::buildModel<BV>(scenes::icosphere(1, 1));
  const auto b = scenes::buildModel<BV>(scenes::icosphere(1, 1));
  fcl::CollisionResultd result;
  Transform3d X = Transform3d::Identity();
  X.translation() = Vector3d(0.5, 0.25, 0.125);
  fcl::collide(a.get(), Transform3d::Identity(), b.get(), X, fcl::CollisionRequestd(), result);
  EXPECT_EQ(result.numContacts(), 1u);
  return result.getContact(0).o1 == a.get() && result.getContact(0).o2 == b.get();
}

TEST(FclDefect15, ContactsNameCopiesThatAreGone) {
  EXPECT_TRUE(contactsNameTheModels<kIOSd>());
  EXPECT_FALSE(contactsNameTheModels<fcl::RSSd>());
}

}  // namespace
}  // namespace kios::testing
