// SPDX-FileCopyrightText: 2026 The fcl_kios authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <Eigen/Core>
#include <utility>
#include <vector>

namespace kios {

/// {center + axes diag(half) x : |x| <= 1}: an ellipsoid that contains points to 1e-9 of its size.
struct EnclosingEllipsoid {
  Eigen::Vector3d center = Eigen::Vector3d::Zero();
  Eigen::Matrix3d axes = Eigen::Matrix3d::Identity();  ///< orthonormal columns
  Eigen::Vector3d half = Eigen::Vector3d::Zero();      ///< decreasing; 0 beyond the rank
  int rank = 0;                                        ///< dimension of the points' affine hull
  /// The certificate: weights > 0 with sum 1 of some points. With the covariance C that they give
  /// in the affine hull, no enclosing ellipsoid has less than the volume of x^T C^-1 x <= rank
  /// (weak duality).
  std::vector<std::pair<int, double>> weights;
  /// The ellipsoid's volume is at most (1 + gap)^(rank/2) times the least.
  double gap = 0;
};

/// The smallest enclosing ellipsoid of points (coordinates of about 1) in their affine hull, the
/// directions in which they spread less than 1e-6 of the most left out; gap <= tolerance unless
/// that takes more than a thousand rounds: below 1e-3 it may, where more points than fix the
/// ellipsoid lie next to it (a sphere's, a cube's corners).
///
/// Khachiyan's dual problem (1996), as Todd and Yildirim pose it ("On Khachiyan's algorithm for the
/// computation of minimum-volume enclosing ellipsoids", 2007). Their away steps take hundreds of
/// rounds for many points near the boundary; the exchanges of Harman, Filova and Richtarik ("A
/// randomized exchange algorithm for computing optimal approximate designs of experiments", 2020),
/// here in a fixed order, three to ten. Points are eliminated as by Harman and Pronzato
/// ("Improvements on removing nonoptimal support points in D-optimum design algorithms", 2007), so
/// that a round is linear in those that may still matter.
EnclosingEllipsoid smallestEllipsoid(Eigen::Matrix3Xd points, double tolerance);

}  // namespace kios
