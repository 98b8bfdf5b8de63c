// SPDX-FileCopyrightText: 2026 The fcl_kios authors
// SPDX-License-Identifier: BSD-3-Clause
//
// Every constant of volume/error_bounds.h against what rounding really does, over random input of
// mixed scales: no error exceeds its bound, and the largest that is met takes a share of it that is
// stated here. So a constant that is too small fails, and so does one that is larger than its
// reason: divided by `room` each bound is exceeded.

#include "volume/error_bounds.h"

#include <cmath>
#include <type_traits>

#include <gtest/gtest.h>
#include <boost/multiprecision/cpp_bin_float.hpp>
#include <boost/multiprecision/eigen.hpp>
#include "fcl_kios/triangle.h"
#include "fcl_kios/volume.h"
#include "query/posed_solid.h"
#include "scalars.h"
#include "scenes/motions.h"
#include "scenes/random.h"
#include "scenes/rational_oracle.h"
#include "scenes/triangle_classes.h"
#include "search/feature_distance.h"

namespace kios::testing {
namespace {

using Exact = boost::multiprecision::cpp_bin_float_100;
using ExactVector = Eigen::Matrix<Exact, 3, 1>;

/// Holds the largest share of a bound that errors took.
class Share {
 public:
  void add(double error, double bound) {
    if (bound > 0) largest_ = std::max(largest_, error / bound);
  }
  void expectWithin(const char* name, double room) const {
    ::testing::Test::RecordProperty(name, std::to_string(largest_));
    EXPECT_LE(largest_, 1) << name;
    EXPECT_GT(largest_, 1 / room) << name << ": larger than its reason";
  }

 private:
  double largest_ = 0;
};

template <typename S>
fcl::Vector3<S> randomPoint(scenes::Random& random) {
  const double scale = std::ldexp(1.0, static_cast<int>(random.uniform(-8, 9)));
  fcl::Vector3<S> p;
  // Numbers with all their bits, some of them small, so that sums are not dominated by one term.
  for (int i = 0; i < 3; ++i) {
    p[i] = static_cast<S>(scale * random.uniform(-1, 1) * (random.unit() < 0.3 ? 1e-3 : 1));
  }
  return p;
}

template <typename S>
fcl::Transform3<S> randomPose(scenes::Random& random) {
  const auto seed = static_cast<std::uint64_t>(random.uniform(0, 1e9));
  fcl::Transform3<S> X = scenes::randomPoses(1, 1, seed)[0].cast<S>();
  X.translation() = randomPoint<S>(random);
  return X;
}

template <typename Matrix>
auto exact(const Matrix& m) {
  return Eigen::Matrix<Exact, Matrix::RowsAtCompileTime, Matrix::ColsAtCompileTime>(
      m.template cast<Exact>());
}

double length(const ExactVector& x) { return static_cast<double>(x.norm()); }
template <typename S>
double norm1(const fcl::Vector3<S>& v) {
  return v.template cast<double>().template lpNorm<1>();
}

KIOS_SCALAR_SUITE(ErrorBounds);

TYPED_TEST(ErrorBounds, PointsInTheCommonFrame) {
  using S = TypeParam;
  scenes::Random random(1);
  Share frame, sum;
  for (int i = 0; i < 20000; ++i) {
    const auto X_WA = randomPose<S>(random), X_WB = randomPose<S>(random);
    const RelativePose<S> X_AB(X_WA, X_WB);
    const fcl::Vector3<S> x = randomPoint<S>(random), computed = X_AB * x;
    const ExactVector in_world =
        exact(X_WB.linear()) * exact(x) + exact(X_WB.translation()) - exact(X_WA.translation());
    const double off = length(exact(X_WA.linear()).transpose() * in_world - exact(computed));
    frame.add(off, error_bounds::frameError<S>(norm1<S>(x), detail::boundsOf(X_AB).T_norm1));
    // Against the frame as it is stored.
    const ExactVector stored = exact(X_AB.R()) * exact(x) + exact(X_AB.T());
    sum.add(length(stored - exact(computed)),
            error_bounds::sumError<S>(1.8 * norm1<S>(x) + detail::boundsOf(X_AB).T_norm1));
  }
  frame.expectWithin("frame", 8);
  sum.expectWithin("sum", 32);
}

TYPED_TEST(ErrorBounds, Stretch) {
  using S = TypeParam;
  scenes::Random random(2);
  Share share;
  for (int i = 0; i < 2000; ++i) {
    auto X_WA = randomPose<S>(random);
    const auto X_WB = randomPose<S>(random);
    // Longer along one axis, so that the whole error is in one direction.
    const double longer = std::pow(10, random.uniform(-12, -4.4));
    X_WA.linear().col(0) *= static_cast<S>(1 + longer);
    const RelativePose<S> X_AB(X_WA, X_WB);
    // The frame's first coordinate is along that axis of A.
    const ExactVector row = exact(X_WB.linear()).transpose() * exact(X_WA.linear().col(0));
    share.add(length(row) - 1, detail::boundsOf(X_AB).stretch);
  }
  share.expectWithin("stretch", 2);
}

// The float lanes of separation(): the best of all pairs of spheres, in long double.
TEST(ErrorBoundsOfLanes, CapsAgainstCaps) {
  scenes::Random random(3);
  Share share;
  int lanes_decide = 0;
  for (int i = 0; i < 20000; ++i) {
    fcl::Vector3d points[2][4];
    kIOSd bv[2];
    for (int k = 0; k < 2; ++k) {
      for (auto& p : points[k]) {
        p = randomPoint<double>(random);
        p[i % 3] *= 1e-3;
      }
      fit(points[k], 4, bv[k]);
    }
    if ((bv[0].exponent | bv[1].exponent) != 0) continue;
    const auto X_WA = randomPose<double>(random), X_WB = randomPose<double>(random);
    const RelativePose<double> X(X_WA, X_WB);
    const double bound = separation(bv[0], bv[1], X, std::numeric_limits<double>::infinity());
    double best = -std::numeric_limits<double>::infinity(), central = 0;
    for (int a = 0; a < bv[0].k(); ++a) {
      for (int b = 0; b < bv[1].k(); ++b) {
        // Centres as they are stored: S0's and the offset from it.
        const auto center = [](const kIOSd& v, int s) {
          ExactVector c = exact(v.center0);
          if (s > 0) c += exact(Eigen::Vector3f(v.cap_x[s - 1], v.cap_y[s - 1], v.cap_z[s - 1]));
          return c;
        };
        const auto radius = [](const kIOSd& v, int s) {
          return s == 0 ? double{v.radius0} : double{v.cap_r[s - 1]};
        };
        const ExactVector c_b = exact(X.R()) * center(bv[1], b) + exact(X.T());
        const double value = length(c_b - center(bv[0], a)) - radius(bv[0], a) - radius(bv[1], b);
        if (a + b == 0) central = value;
        best = std::max(best, value);
      }
    }
    ASSERT_LE(bound, best);
    const fcl::Vector3d d = X * bv[1].center0 - bv[0].center0;
    const double scale = norm1<double>(d) + bv[0].reach + bv[1].reach;
    const double lanes = error_bounds::laneError(scale);
    const double central_pad = detail::boundsOf(X).stretch * bv[1].radius0 +
                               error_bounds::volumeError<double>(
                                   norm1<double>(bv[1].center0),
                                   detail::boundsOf(X).T_norm1 + norm1<double>(bv[0].center0),
                                   bv[0].radius0, bv[1].radius0);
    // Only where the caps, not the central spheres in double, gave the bound.
    if (!(bound > central - central_pad + 1e-14 * scale)) continue;
    ++lanes_decide;
    const double pads = lanes + detail::boundsOf(X).stretch * bv[1].reach + central_pad;
    share.add(std::abs(bound + pads - best), lanes);
  }
  EXPECT_GT(lanes_decide, 1000);
  share.expectWithin("lanes", 16);
}

TYPED_TEST(ErrorBounds, TrianglesAndTheirFeatures) {
  using S = TypeParam;
  Share triangles, features;
  for (std::size_t c = 0; c < scenes::triangleClasses().size(); ++c) {
    for (const scenes::TrianglePair& pair : scenes::trianglePairs(c, 60, 5)) {
      if (!(scenes::magnitude(pair) < 1e18) || !(scenes::extent(pair) > 1e-9)) continue;
      TriangleVertices<S> a, b;
      scenes::TrianglePair rounded;
      for (int k = 0; k < 3; ++k) {
        for (int i = 0; i < 3; ++i) {
          volatile S x = static_cast<S>(pair.a[k][i]), y = static_cast<S>(pair.b[k][i]);
          rounded.a[k][i] = a[k][i] = x;
          rounded.b[k][i] = b[k][i] = y;
        }
      }
      const double extent = static_cast<double>(scenes::extent(rounded));
      const auto oracle = scenes::rationalDistance(rounded);
      const double distance = triangleDistance(a, b).distance;
      triangles.add(
          std::abs(static_cast<double>(static_cast<long double>(distance) - oracle.distance)),
          error_bounds::triangleError<S>(extent));
      // The best pair of edges is as near as the triangles, or a vertex over a face is.
      double nearest = std::numeric_limits<double>::infinity();
      for (int k = 0; k < 3; ++k) {
        for (int m = 0; m < 3; ++m) {
          engine::NearestEnds ends;
          nearest =
              std::min(nearest, engine::edgeDistance(rounded.a[k], rounded.a[(k + 1) % 3],
                                                     rounded.b[m], rounded.b[(m + 1) % 3], ends)
                                    .distance);
        }
        const FacePlane of_b({rounded.b[0], rounded.b[1], rounded.b[2]});
        nearest = std::min(nearest, engine::faceDistance(of_b, rounded.a[k]).distance);
        const FacePlane of_a({rounded.a[0], rounded.a[1], rounded.a[2]});
        nearest = std::min(nearest, engine::faceDistance(of_a, rounded.b[k]).distance);
      }
      if (oracle.intersect) continue;
      const double in_double = triangleDistance<double>({rounded.a[0], rounded.a[1], rounded.a[2]},
                                                        {rounded.b[0], rounded.b[1], rounded.b[2]})
                                   .distance;
      features.add(std::abs(nearest - in_double), error_bounds::featureError(extent));
    }
  }
  triangles.expectWithin("triangles", 64);
  features.expectWithin("features", 128);
}

TYPED_TEST(ErrorBounds, PointsInASolidsFrame) {
  using S = TypeParam;
  scenes::Random random(4);
  Share share;
  for (int i = 0; i < 20000; ++i) {
    const auto X_WM = randomPose<S>(random), X_WS = randomPose<S>(random);
    kIOS<S> root;
    const fcl::Vector3<S> x = randomPoint<S>(random);
    fit(&x, 1, root);
    shape::Solid point;
    const PosedSolid posed(point, X_WM, X_WS,
                           kios::Mesh(engine::MeshView<S>(), engine::Tree(), root, nullptr));
    const ExactVector in_world =
        exact(X_WM.linear()) * exact(x) + exact(X_WM.translation()) - exact(X_WS.translation());
    const ExactVector placed = exact(X_WS.linear()).transpose() * in_world;
    const shape::Vec computed = posed.place(x.template cast<double>());
    const double lengths = 1.8 * norm1<S>(x) + norm1<S>(X_WM.translation() - X_WS.translation());
    share.add(length(placed - exact(computed)), error_bounds::solidError(lengths));
  }
  share.expectWithin("solid", 64);
}

}  // namespace
}  // namespace kios::testing
