// SPDX-FileCopyrightText: 2026 The fcl_kios authors
// SPDX-License-Identifier: BSD-3-Clause
//
// The promises of fcl::DistanceRequest and of a DistanceResult on entry are kept.

#include <gtest/gtest.h>

#include <cmath>
#include <tuple>

#include <fcl/broadphase/broadphase_bruteforce.h>
#include <fcl/geometry/octree/octree.h>

#include "fcl/expect_refused.h"
#include "fcl/mesh_cases.h"
#include "not_finite.h"

namespace kios::testing {
namespace {

constexpr double kMax = std::numeric_limits<double>::max();

fcl::DistanceRequestd withErrors(double rel_err, double abs_err) {
  fcl::DistanceRequestd request(true);
  request.rel_err = rel_err;
  request.abs_err = abs_err;
  return request;
}

class Request : public ::testing::Test {
 protected:
  double distance(const Frame& frame, const fcl::DistanceRequestd& request,
                  fcl::DistanceResultd& result) const {
    return fcl::distance(a_.get(), frame.X_WA, b_.get(), frame.X_WB, request, result);
  }
  double exact(const Frame& frame) const {
    fcl::DistanceResultd result;
    return distance(frame, fcl::DistanceRequestd(), result);
  }
  int bvTests(const Frame& frame, const fcl::DistanceRequestd& request) const {
    fcl::DistanceResultd result;
    MeshDistanceTraversalNode<double> node;
    initialize(node, *std::as_const(a_), frame.X_WA, *std::as_const(b_), frame.X_WB, request,
               result);
    node.enable_statistics = true;
    fcl::detail::distance(&node);
    return node.num_bv_tests;
  }

  const std::shared_ptr<Modeld> a_ = kiosModel(scenes::bumpyTorus(600));
  const std::shared_ptr<Modeld> b_ = kiosModel(scenes::bumpyTorus(400));
  const std::vector<Frame> frames_ = randomFrames(80, 1.8, 41);
};

TEST_F(Request, ErrorBoundsAreKeptAndSaveWork) {
  const std::vector<std::pair<double, double>> bounds{
      {0, 0},   {1e-3, 0}, {0.1, 0},   {0.5, 0},    {0.99, 0}, {0, 1e-3}, {0, 0.05},
      {0, 0.5}, {0, 1e30}, {0.1, 0.3}, {0.5, 1e-9}, {0, 2},    {0, kMax}, {0, kInfinity}};
  std::vector<long> work(bounds.size(), 0);
  for (const Frame& frame : frames_) {
    const double d_exact = exact(frame);
    for (std::size_t i = 0; i < bounds.size(); ++i) {
      const auto [rel, abs] = bounds[i];
      fcl::DistanceResultd result;
      const double d = distance(frame, withErrors(rel, abs), result);
      EXPECT_EQ(d, result.min_distance);
      EXPECT_GE(d, d_exact - 1e-15);
      EXPECT_LE(d - d_exact, std::max(rel * d_exact, abs) + 1e-15);
      EXPECT_GE(result.b1, 0);  // the distance of two triangles, however large the error
      if (d > 0) {
        EXPECT_NEAR((result.nearest_points[0] - result.nearest_points[1]).norm(), d, 1e-12);
      }
      work[i] += bvTests(frame, withErrors(rel, abs));
    }
  }
  for (const std::size_t i : {1u, 2u, 3u, 4u}) EXPECT_LT(work[i], work[i - 1]) << i;
  EXPECT_LT(work[5], work[0]);
  for (const std::size_t i : {6u, 7u}) EXPECT_LT(work[i], work[i - 1]) << i;
  EXPECT_LE(work[8], work[7]);
}

// With 10 in hand and an error of max(rel * d, abs), only pairs beyond this can be left out.
TEST_F(Request, StopsWhereTheErrorAllowsAndNoSooner) {
  const Frame& frame = frames_.front();
  for (const auto& [rel, abs, stop] :
       {std::tuple(0.0, 0.0, 10.0), std::tuple(0.25, 0.0, 8.0), std::tuple(0.0, 4.0, 6.0),
        std::tuple(0.25, 1.0, 8.0), std::tuple(0.25, 4.0, 6.0)}) {
    fcl::DistanceResultd result(10);
    MeshDistanceTraversalNode<double> node;
    initialize(node, *std::as_const(a_), frame.X_WA, *std::as_const(b_), frame.X_WB,
               withErrors(rel, abs), result);
    node.preprocess();
    EXPECT_TRUE(node.canStop(stop + 1e-9)) << rel << ' ' << abs;
    EXPECT_FALSE(node.canStop(stop - 1e-9)) << rel << ' ' << abs;
    EXPECT_FALSE(node.canStop(-1));
  }
}

TEST_F(Request, ErrorBoundsThatAreNoNumbersOrNegativeAreRefused) {
  const Frame& frame = frames_.front();
  for (const double bad : {-1e-300, -1.0, -kInfinity, kNaN}) {
    fcl::DistanceResultd result;
    expectRefused([&] { distance(frame, withErrors(bad, 0), result); }, "rel_err");
    expectRefused([&] { distance(frame, withErrors(0, bad), result); }, "abs_err");
    EXPECT_EQ(result.min_distance, kMax);
  }
  fcl::DistanceResultd result;
  EXPECT_NO_THROW(distance(frame, withErrors(-0.0, -0.0), result));
}

// Callers who confuse the request's arguments: FCL never looks at rel_err, ours would answer with
// up to twice the distance and more.
TEST_F(Request, ArgumentsInTheWrongPlaceAreRefused) {
  const char* const order = "(enable_nearest_points, enable_signed_distance, rel_err, abs_err";
  const Transform3d here = Transform3d::Identity(), there(Eigen::Translation3d(9, 0, 0));
  const auto sphere = std::make_shared<fcl::Sphered>(1);
  const auto cells = std::make_shared<octomap::OcTree>(0.1);
  cells->updateNode(octomap::point3d(0, 0, 0), true);
  const auto octree = std::make_shared<fcl::OcTreed>(cells);
  const auto float_model = scenes::buildModel<kIOSf>(scenes::icosphere(1, 1));
  const std::vector<std::shared_ptr<fcl::CollisionGeometryd>> others{b_, sphere, octree};
  for (const auto& request :
       {fcl::DistanceRequestd(true, true, fcl::GST_INDEP),  // the solver as the third
        fcl::DistanceRequestd(true, false, 5.0, 0.01), fcl::DistanceRequestd(false, false, 1),
        withErrors(kInfinity, 0), withErrors(std::nextafter(1, 2), kInfinity)}) {
    for (const auto& other : others) {
      fcl::CollisionObjectd o1(a_, here), o2(other, there);
      fcl::DistanceResultd result;
      expectRefused([&] { fcl::distance(&o1, &o2, request, result); }, order);
      expectRefused([&] { fcl::distance(&o2, &o1, request, result); }, order);
      expectRefused([&] { fcl::distance(a_.get(), here, other.get(), there, request, result); },
                    order);
      fcl::DefaultDistanceData<double> data;
      data.request = request;
      double dist = kMax;
      expectRefused([&] { fcl::DefaultDistanceFunction(&o1, &o2, &data, dist); }, order);
      fcl::NaiveCollisionManagerd manager;
      manager.registerObject(&o1);
      manager.registerObject(&o2);
      manager.setup();
      expectRefused([&] { manager.distance(&data, fcl::DefaultDistanceFunction<double>); }, order);
      EXPECT_EQ(result.o1, nullptr);
      EXPECT_EQ(data.result.o1, nullptr);
    }
    fcl::DistanceRequestf in_float(true);
    in_float.rel_err = static_cast<float>(request.rel_err);
    fcl::DistanceResultf result;
    expectRefused(
        [&] {
          fcl::distance(float_model.get(), fcl::Transform3f::Identity(), float_model.get(),
                        fcl::Transform3f::Identity(), in_float, result);
        },
        order);
    // FCL's own pairs are as in FCL.
    fcl::DistanceResultd of_spheres;
    EXPECT_NEAR(fcl::distance(sphere.get(), here, sphere.get(), there, request, of_spheres), 7,
                1e-5);
  }
  // That error is welcome where it is asked for by name.
  DistanceBracketRequest<double> options;
  for (const double rel_err : {3.0, kMax, kInfinity}) {
    options.rel_err = rel_err;
    const auto answer = kios::distanceBracket(*a_, here, *b_, there, options);
    EXPECT_LT(answer.distance, 100) << rel_err;
    EXPECT_GE(answer.triangle_a, 0) << rel_err;
  }
  fcl::DistanceResultd result;
  EXPECT_NO_THROW(fcl::distance(a_.get(), here, b_.get(), there,
                                withErrors(std::nextafter(1, 0), kMax), result));
}

// No farther than the bound, no worse than the error allows.
TEST_F(Request, MinDistanceOnEntryAndErrorsAtOnce) {
  for (const Frame& frame : frames_) {
    const double d_exact = exact(frame);
    fcl::DistanceResultd result(1.2 * d_exact);
    const double d = distance(frame, withErrors(0.5, 0), result);
    EXPECT_LE(d, 1.2 * d_exact);
    EXPECT_GE(d, d_exact);
    EXPECT_EQ(d, result.min_distance);
  }
}

TEST_F(Request, MinDistanceOnEntrySavesWork) {
  Frame frame{Transform3d::Identity(), Transform3d::Identity()};
  frame.X_WB.translation() = Vector3d(20, 0, 0);
  fcl::DistanceResultd result(1);
  MeshDistanceTraversalNode<double> node;
  initialize(node, *std::as_const(a_), frame.X_WA, *std::as_const(b_), frame.X_WB,
             fcl::DistanceRequestd(), result);
  node.enable_statistics = true;
  fcl::detail::distance(&node);
  EXPECT_LE(node.num_bv_tests, 2);
  EXPECT_EQ(node.num_leaf_tests, 0);
}

TEST_F(Request, SignedDistanceOfMeshesIsZeroAtOverlap) {
  int overlaps = 0;
  for (const Frame& frame : frames_) {
    const double d_exact = exact(frame);
    overlaps += d_exact == 0;
    for (const auto solver : {fcl::GST_LIBCCD, fcl::GST_INDEP}) {
      fcl::DistanceRequestd request(true, true);
      request.gjk_solver_type = solver;
      fcl::DistanceResultd result;
      EXPECT_EQ(distance(frame, request, result), d_exact);
      EXPECT_EQ(result.min_distance, d_exact);
      EXPECT_EQ(result.o1, a_.get());
      EXPECT_EQ(result.o2, b_.get());
      EXPECT_TRUE(result.nearest_points[0].allFinite());
      EXPECT_TRUE(result.nearest_points[1].allFinite());
    }
  }
  EXPECT_GT(overlaps, 5);
}

}  // namespace
}  // namespace kios::testing
