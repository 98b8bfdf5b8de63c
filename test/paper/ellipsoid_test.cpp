// SPDX-FileCopyrightText: 2026 The fcl_kios authors
// SPDX-License-Identifier: BSD-3-Clause
//
// The smallest enclosing ellipsoid: known ones, containment, and a certificate of optimality that
// is recomputed here from the weights alone.
#include <gtest/gtest.h>

#include "paper/enclosing_ellipsoid.h"
#include "volume/exact_spheres.h"

namespace kios::testing {
namespace {

/// Points as an ellipsoid is asked for.
Eigen::Matrix3Xd columnsOf(const Points<double>& points) {
  Eigen::Matrix3Xd columns(3, points.size());
  for (std::size_t i = 0; i < points.size(); ++i) {
    columns.col(static_cast<Eigen::Index>(i)) = points[i];
  }
  return columns;
}

/// Returns why e is no enclosing ellipsoid of volume at most (1 + gap)^(rank/2) times the least;
/// empty if it is one.
std::string wrong(const EnclosingEllipsoid& e, const Eigen::Matrix3Xd& points) {
  if (!(e.axes.transpose() * e.axes).isIdentity(1e-9)) return "axes are not orthonormal";
  for (int k = 0; k < 3; ++k) {
    if (!std::isfinite(e.half[k]) || (k < e.rank) != (e.half[k] > 0)) return "half axes";
    if (k > 0 && e.half[k] > e.half[k - 1]) return "half axes are not sorted";
  }
  // Containment within the affine hull; across it the points lie within what counts as flat.
  for (int i = 0; i < points.cols(); ++i) {
    const fcl::Vector3d x = e.axes.transpose() * (points.col(i) - e.center);
    double sum = 0;
    for (int k = 0; k < e.rank; ++k) sum += x[k] * x[k] / (e.half[k] * e.half[k]);
    // Coordinates relative to the centre are known to 1e-15 of their size.
    if (sum > 1 + 1e-8 + 1e-13 / (e.rank ? e.half[e.rank - 1] : 1)) return "a point is outside";
    for (int k = e.rank; k < 3; ++k) {
      if (std::abs(x[k]) > 2e-6 * std::sqrt(points.cols()) * e.half[0]) return "not flat";
    }
  }
  if (e.rank == 0) return {};
  // Weak duality: the covariance of any weights bounds the least volume from below.
  using Wide = Eigen::Matrix<long double, 3, 3>;
  using WideVec = Eigen::Matrix<long double, 3, 1>;
  WideVec mean = WideVec::Zero();
  long double total = 0;
  for (const auto& [i, w] : e.weights) {
    if (!(w > 0)) return "a weight is not positive";
    mean += w * points.col(i).cast<long double>();
    total += w;
  }
  if (std::abs(total - 1) > 1e-9) return "weights do not sum to 1";
  Wide covariance = Wide::Zero();
  for (const auto& [i, w] : e.weights) {
    const WideVec d =
        e.axes.transpose().cast<long double>() * (points.col(i).cast<long double>() - mean);
    covariance += w * d * d.transpose();
  }
  for (int k = e.rank; k < 3; ++k) {
    covariance.row(k).setZero();
    covariance.col(k).setZero();
    covariance(k, k) = 1;
  }
  long double ratio = 1 / covariance.determinant();
  for (int k = 0; k < e.rank; ++k)
    ratio *= e.half[k] * e.half[k] / static_cast<long double>(e.rank);
  if (!(ratio <= std::pow(1 + e.gap, e.rank) * (1 + 1e-5))) {
    return "volume is above the certified: " + std::to_string(static_cast<double>(ratio));
  }
  if (!(ratio >= 1 - 1e-5)) return "volume is below the dual's";
  return {};
}

TEST(Ellipsoid, IsCertifiedOnHardSets) {
  Random random(2);
  int ranks[4] = {};
  for (int set = 0; set < 20'000; ++set) {
    const bool large = set % 333 == 0;
    const auto shape = static_cast<PointShape>(below(random, kPointShapes));
    const int count = large ? 500 + below(random, 3000) : randomCount(random);
    const auto points = columnsOf(place<double>(random, shapePoints(random, shape, count), 0, 1));
    const EnclosingEllipsoid e = smallestEllipsoid(points, 1e-3);
    ASSERT_LE(e.gap, 1e-3) << "set " << set << " shape " << static_cast<int>(shape);
    ASSERT_EQ(wrong(e, points), "") << "set " << set << " shape " << static_cast<int>(shape)
                                    << " n = " << points.cols() << " rank " << e.rank;
    ++ranks[e.rank];
  }
  for (const int count : ranks) EXPECT_GT(count, 500);
}

TEST(Ellipsoid, OfASegmentAndOfAPoint) {
  const EnclosingEllipsoid segment = smallestEllipsoid(
      columnsOf(Points<double>{{0, 0, 0}, {1, 2, 2}, {2, 4, 4}, {0.5, 1, 1}}), 1e-6);
  EXPECT_EQ(segment.rank, 1);
  EXPECT_NEAR(segment.half[0], 3, 1e-5);
  EXPECT_EQ(segment.half[1], 0);
  EXPECT_LT((segment.center - fcl::Vector3d(1, 2, 2)).norm(), 1e-5);

  const EnclosingEllipsoid point =
      smallestEllipsoid(columnsOf(Points<double>{{1, 2, 3}, {1, 2, 3}}), 1e-6);
  EXPECT_EQ(point.rank, 0);
  EXPECT_EQ(point.half, fcl::Vector3d(0, 0, 0));
  EXPECT_EQ(point.center, fcl::Vector3d(1, 2, 3));
}

}  // namespace
}  // namespace kios::testing
