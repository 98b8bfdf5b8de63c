// SPDX-FileCopyrightText: 2026 The fcl_kios authors
// SPDX-License-Identifier: BSD-3-Clause
//
// Defects of FCL 0.7's own kIOS and of the mesh code around it that our users must not meet. Each
// test runs one check over ours, which passes it, and over FCL's, which fails it: once FCL is
// mended the test says so.

#include <gtest/gtest.h>

#include <fcl/math/motion/translation_motion.h>
#include <fcl/narrowphase/detail/traversal/distance/mesh_distance_traversal_node.h>

#include "fcl/mesh_cases.h"
#include "model/deform.h"
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

TEST(FclDefect10, ConstructBoxIgnoresThePose) { EXPECT_FALSE(boxIsAtThePose<FclKios>()); }

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

TEST(FclDefect14, ReusedResultIsMovedAgainOverObbrss) {
  EXPECT_FALSE(reusedResultKeepsItsPoints<fcl::OBBRSSd>());
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

// The nearest points of a mesh and a sphere are as far apart as the answer says, and each is on its
// object.
template <typename BV>
bool nearestPointsToASphereAreRight() {
  const Mesh mesh = scenes::icosphere(0.6, 1);
  const auto model = scenes::buildModel<BV>(mesh);
  const fcl::Sphered sphere(0.5);
  const Transform3d I = Transform3d::Identity();
  for (const Transform3d& X : scenes::randomPoses(20, 2, 124)) {
    fcl::DistanceResultd result;
    const double d = fcl::distance(model.get(), I, &sphere, X, fcl::DistanceRequestd(true), result);
    if (!(d > 1e-6)) continue;
    const bool model_is_first = result.o1 == model.get();
    const Vector3d& p = result.nearest_points[model_is_first ? 0 : 1];
    const Vector3d& q = result.nearest_points[model_is_first ? 1 : 0];
    const auto triangle = model_is_first ? result.b1 : result.b2;
    if (triangle < 0 || triangle >= model->num_tris || std::abs((p - q).norm() - d) > 1e-6 ||
        distanceToTriangle(p, I, mesh, triangle) > 1e-6 ||
        std::abs((q - X.translation()).norm() - 0.5) > 1e-6) {
      return false;
    }
  }
  return true;
}

TEST(FclDefect16, NearestPointsToASphere) {
  EXPECT_TRUE(nearestPointsToASphereAreRight<kIOSd>());
  EXPECT_FALSE(nearestPointsToASphereAreRight<fcl::OBBRSSd>());
}

template <typename BV>
double distanceToAHalfspace() {
  const auto model = scenes::buildModel<BV>(scenes::icosphere(0.6, 1));
  const fcl::Halfspaced halfspace(Vector3d::UnitZ(), -2);
  const Transform3d I = Transform3d::Identity();
  fcl::DistanceResultd result;
  return fcl::distance(model.get(), I, &halfspace, I, fcl::DistanceRequestd(), result);
}

// FCL calls a null pointer, here in a process of its own.
TEST(FclDefect17DeathTest, DistanceToAHalfspace) {
  EXPECT_NEAR(distanceToAHalfspace<kIOSd>(), 1.4, 0.1);
  EXPECT_DEATH(distanceToAHalfspace<fcl::OBBRSSd>(), "");
}

// Two things that fly at each other from 3 to either side of the origin, and hit halfway.
template <typename BV>
struct HeadOn {
  HeadOn(const Mesh& a, const Mesh& b, fcl::CCDSolverType solver) {
    const Transform3d left(Eigen::Translation3d(-3, 0.05, 0));
    const Transform3d right(Eigen::Translation3d(3, 0, 0.02));
    const auto model_a = scenes::buildModel<BV>(a), model_b = scenes::buildModel<BV>(b);
    const fcl::TranslationMotiond motion_a(left, right), motion_b(right, left);
    const fcl::ContinuousCollisionRequestd request(10, 1e-3, fcl::CCDM_TRANS, fcl::GST_LIBCCD,
                                                   solver);
    ::testing::internal::CaptureStderr();  // FCL's messages
    fcl::continuousCollide(model_a.get(), &motion_a, model_b.get(), &motion_b, request, result);
    ::testing::internal::GetCapturedStderr();
    unmoved = std::equal(a.vertices.begin(), a.vertices.end(), model_a->vertices);
  }
  fcl::ContinuousCollisionResultd result;
  bool unmoved;
};

// Sampling passes over a contact that is shorter than its steps.
TEST(FclContinuous, NaiveTunnels) {
  const Mesh plate = scenes::subdividedBox({0.01, 2, 2}, 1), ball = scenes::icosphere(0.1, 1);
  const auto kNaive = fcl::CCDC_NAIVE;
  EXPECT_TRUE(HeadOn<kIOSd>(plate, ball, kNaive).result.is_collide);
  EXPECT_FALSE(HeadOn<fcl::OBBRSSd>(plate, ball, kNaive).result.is_collide);
}

TEST(FclDefect20, AdvancementMissesAHeadOnHit) {
  const Mesh box = scenes::subdividedBox({1, 1, 1}, 1);
  const auto kAdvance = fcl::CCDC_CONSERVATIVE_ADVANCEMENT;
  EXPECT_TRUE(HeadOn<kIOSd>(box, box, kAdvance).result.is_collide);
  EXPECT_FALSE(HeadOn<fcl::OBBRSSd>(box, box, kAdvance).result.is_collide);
}

TEST(FclDefect22, PolynomialSolverMovesTheModels) {
  const Mesh box = scenes::subdividedBox({1, 1, 1}, 1);
  EXPECT_TRUE(HeadOn<kIOSd>(box, box, fcl::CCDC_POLYNOMIAL_SOLVER).unmoved);
  EXPECT_FALSE(HeadOn<fcl::OBBRSSd>(box, box, fcl::CCDC_POLYNOMIAL_SOLVER).unmoved);
}

// Number of frames in which the distance is off by more than 1e-12, all objects moved by `offset`.
template <typename BV>
int wrongDistances(const fcl::BVHModel<BV>& model, const Mesh& mesh, const Vector3d& offset) {
  const Mesh other = scenes::icosphere(0.7, 1);
  const auto other_model = scenes::buildModel<BV>(other);
  const scenes::MeshOracle oracle(mesh, other);
  int wrong = 0;
  for (const Frame& frame : randomFrames(20, 1.2, 125, offset)) {
    fcl::DistanceResultd result;
    const double d = fcl::distance(&model, frame.X_WA, other_model.get(), frame.X_WB,
                                   fcl::DistanceRequestd(), result);
    wrong += !(std::abs(d - oracle.distance(frame.X_WA, frame.X_WB)) <= 1e-12);
  }
  return wrong;
}

template <typename BV>
int wrongAtACommonOffset() {
  const Mesh mesh = scenes::bumpyTorus(200);
  return wrongDistances(*scenes::buildModel<BV>(mesh), mesh, Vector3d::Constant(0x1p30));
}

TEST(FclMeshes, ACommonOffsetCostsAccuracy) {
  EXPECT_EQ(wrongAtACommonOffset<kIOSd>(), 0);
  EXPECT_GT(wrongAtACommonOffset<fcl::OBBRSSd>(), 0);
}

template <typename BV>
int wrongAfterABottomUpRefit() {
  Mesh mesh = scenes::bumpyTorus(200);
  const auto model = scenes::buildModel<BV>(mesh);
  mesh.vertices = swayed(mesh, 0.7);
  model->beginReplaceModel();
  model->replaceSubModel(mesh.vertices);
  model->endReplaceModel(true, true);
  return wrongDistances(*model, mesh, Vector3d::Zero());
}

TEST(FclMeshes, ABottomUpRefitLosesContent) {
  EXPECT_EQ(wrongAfterABottomUpRefit<kIOSd>(), 0);
  EXPECT_GT(wrongAfterABottomUpRefit<fcl::OBBRSSd>(), 0);
}

}  // namespace
}  // namespace kios::testing
