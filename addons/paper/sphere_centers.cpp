// SPDX-FileCopyrightText: 2026 The fcl_kios authors
// SPDX-License-Identifier: BSD-3-Clause
#include "paper/sphere_centers.h"

#include <Eigen/Eigenvalues>
#include <algorithm>
#include <cmath>

#include "build/four_axes.h"
#include "build/measure.h"
#include "paper/enclosing_ellipsoid.h"
#include "paper/recenter.h"
#include "volume/assemble.h"
#include "volume/balls.h"
#include "volume/errors.h"

namespace kios {
namespace {

/// The spheres that a node with the half extents a >= b >= c is given: paper, III-C. The case
/// a/b > 1.5 and a/c < 1.5, which it leaves out, can't occur; a ratio of 1.5 counts as below it.
int sphereCount(double a, double b, double c, double ratio, SphereCount count, int most) {
  if (!(a > 0)) return 1;
  if (count != SphereCount::kByRatio) return most;
  return a <= ratio * c ? 1 : std::min(most, a <= ratio * b ? 3 : most);
}

constexpr double kPublishedRatio = 1.5;

/// Largest distance of a point from the line through the origin along `axis`.
double lateralRadius(const Eigen::Matrix3Xd& points, int axis) {
  const auto u = points.row((axis + 1) % 3), v = points.row((axis + 2) % 3);
  return std::sqrt((u.cwiseAbs2() + v.cwiseAbs2()).maxCoeff());
}

/// Sets the box along the axes, and the points from its middle.
void setBox(const Eigen::Matrix3Xd& points, PrincipalFrame& frame, Eigen::Matrix3Xd& in_frame) {
  in_frame = frame.axes.transpose() * points;
  const Eigen::Vector3d low = in_frame.rowwise().minCoeff(), high = in_frame.rowwise().maxCoeff();
  frame.middle = 0.5 * (low + high);
  frame.half = 0.5 * (high - low);
  in_frame.colwise() -= frame.middle;
  frame.order = longestFirst(frame.half);
}

/// The frame of the smallest enclosing ellipsoid: middle and half extents are its centre and
/// semi-axes (paper, III-B.1).
PrincipalFrame ellipsoidFrame(const Eigen::Matrix3Xd& in_frame, const PrincipalFrame& principal) {
  constexpr double kTolerance = 1e-3;  // the volume is within 0.15 % of the least
  const EnclosingEllipsoid ellipsoid = smallestEllipsoid(in_frame, kTolerance);
  PrincipalFrame frame;
  frame.axes = principal.axes * ellipsoid.axes;
  frame.middle = ellipsoid.axes.transpose() * (ellipsoid.center + principal.middle);
  frame.half = ellipsoid.half;
  return frame;
}

}  // namespace

PrincipalFrame principalFrame(const Eigen::Matrix3Xd& points, Eigen::Matrix3Xd& in_frame) {
  const Eigen::Matrix3Xd around = points.colwise() - points.rowwise().mean().eval();
  PrincipalFrame frame;
  frame.axes =
      Eigen::SelfAdjointEigenSolver<Eigen::Matrix3d>(around * around.transpose()).eigenvectors();
  setBox(points, frame, in_frame);
  return frame;
}

SphereCenters tunedCenters(const Eigen::Matrix3Xd& in_frame, const PrincipalFrame& frame,
                           const FitOptions& options, int most) {
  SphereCenters centers;
  const auto& order = frame.order;
  const double a = frame.half[order[0]], b = frame.half[order[1]], c = frame.half[order[2]];
  Support support;
  recenterInPlane(in_frame, order[2], centers.sphere[0], support);
  if (c > 0.08 * a) {  // thick: across the shortest axis as well
    Support across;
    recenterInPlane(in_frame, order[0], centers.sphere[0], across);
  }
  constexpr double kRatio = 1.1;  // below it the caps of an axis cut off next to nothing
  centers.k = sphereCount(a, b, c, kRatio, options.count, most);
  const double cotangent = 1 / std::tan(options.angle);
  for (int i = 1; i < centers.k; i += 2) {
    const int axis = axisOfCap(frame, i);
    const double height =
        std::max(0.0, cotangent * lateralRadius(in_frame, axis) - frame.half[axis]);
    for (int side = 0; side < 2; ++side) {
      Eigen::Vector3d& center = centers.sphere[i + side];
      center[axis] = side == 0 ? height : -height;
      recenterInPlane(in_frame, axis, center, support);
    }
  }
  return centers;
}

SphereCenters publishedCenters(const Eigen::Matrix3Xd& in_frame, const PrincipalFrame& frame,
                               const FitOptions& options) {
  SphereCenters centers;
  const auto& order = frame.order;
  const double a = frame.half[order[0]], b = frame.half[order[1]], c = frame.half[order[2]];
  centers.k = sphereCount(a, b, c, kPublishedRatio, options.count, 5);
  const double r0_squared = farthestSquare(in_frame, Eigen::Vector3d::Zero());
  const double r1 = std::sqrt(std::max(0.0, r0_squared - c * c)) / std::sin(options.angle);
  centers.least_cap_radius = r1;
  for (int i = 1; i < centers.k; ++i) {
    const int axis = axisOfCap(frame, i);
    const double height = i <= 2 ? r1 * std::cos(options.angle) - c
                                 : std::sqrt(std::max(0.0, r1 * r1 - a * a - c * c)) - b;
    Eigen::Vector3d& center = centers.sphere[i];
    const double sign = i % 2 == 1 ? 1 : -1;
    center[axis] = sign * height;
    const double r = std::sqrt(farthestSquare(in_frame, center));
    center[axis] = sign * (height + std::max(0.0, r1 - r));
  }
  return centers;
}

SphereCenters ellipsoidCenters(const PrincipalFrame& frame, const FitOptions& options) {
  SphereCenters centers;
  const auto& order = frame.order;
  const double a = frame.half[order[0]], b = frame.half[order[1]], c = frame.half[order[2]];
  centers.k = sphereCount(a, b, c, kPublishedRatio, options.count, 5);
  if (!(a > 0)) return centers;  // of a point
  const double least =
      a * (options.method == FitMethod::kMethodI ? 1.0 / 256 : std::sin(options.angle));
  const double r1 = a * a / std::max(c, least);
  for (int i = 1; i < centers.k; ++i) {
    const double height = r1 - std::max(i <= 2 ? c : b, least);
    centers.sphere[i][axisOfCap(frame, i)] = i % 2 == 1 ? height : -height;
  }
  return centers;
}

void adjustCenters(const Eigen::Matrix3Xd& in_frame, const PrincipalFrame& frame,
                   const FitOptions& options, SphereCenters& centers) {
  double radius[SphereCenters::kMost];
  int axis[SphereCenters::kMost] = {};
  for (int i = 0; i < centers.k; ++i) {
    radius[i] = std::sqrt(farthestSquare(in_frame, centers.sphere[i]));
    if (i == 0) continue;
    axis[i] = axisOfCap(frame, i);
    radius[i] = std::max(radius[i], centers.least_cap_radius);
  }
  if (options.count == SphereCount::kByGain) {
    constexpr double kLeastGain = 0.1;
    int kept = 1;
    for (int i = 1; i < centers.k; i += 2) {
      // The part of S0 that the far sides of the two caps leave.
      const double middle = centers.sphere[0][axis[i]];
      const double top =
          std::min(middle + radius[0], centers.sphere[i + 1][axis[i]] + radius[i + 1]);
      const double bottom = std::max(middle - radius[0], centers.sphere[i][axis[i]] - radius[i]);
      if (!(top - bottom < (1 - kLeastGain) * 2 * radius[0])) continue;
      for (int side = 0; side < 2; ++side, ++kept) {
        centers.sphere[kept] = centers.sphere[i + side];
        radius[kept] = radius[i + side];
        axis[kept] = axis[i + side];
      }
    }
    centers.k = kept;
  }
  if (options.shared_radius && centers.k > 1) {
    const double shared = *std::max_element(radius + 1, radius + centers.k);
    for (int i = 1; i < centers.k; ++i) {
      const double outwards = i % 2 == 1 ? shared - radius[i] : radius[i] - shared;
      centers.sphere[i][axis[i]] += outwards;
    }
    centers.least_cap_radius = shared;
  }
}

template <typename S>
RelativePoints::RelativePoints(const fcl::Vector3<S>* points, int n) : p(3, n) {
  kios::requireUsable(points, n);
  const Eigen::Vector3d first = points[0].template cast<double>();
  for (int i = 0; i < n; ++i) p.col(i) = points[i].template cast<double>() - first;
  exponent = capExponent(p.cwiseAbs().maxCoeff());
  if (exponent != 0) p = p.unaryExpr([this](double v) { return scaled(v, -exponent); }).eval();
}

template RelativePoints::RelativePoints(const fcl::Vector3<double>*, int);
template RelativePoints::RelativePoints(const fcl::Vector3<float>*, int);

SphereCenters placeCenters(const Eigen::Matrix3Xd& points, const FitOptions& options, int most) {
  Eigen::Matrix3Xd in_frame;
  PrincipalFrame frame = principalFrame(points, in_frame);
  SphereCenters centers;
  switch (options.method) {
    case FitMethod::kTuned:
      centers = tunedCenters(in_frame, frame, options, most);
      break;
    case FitMethod::kMethodI:
    case FitMethod::kMethodIAtAngle:
      frame = ellipsoidFrame(in_frame, frame);
      in_frame = (frame.axes.transpose() * points).colwise() - frame.middle;
      centers = ellipsoidCenters(frame, options);
      break;
    case FitMethod::kMethodII:
      centers = publishedCenters(in_frame, frame, options);
      break;
  }
  centers.k = std::min(centers.k, most);
  if (options.shared_radius || options.count == SphereCount::kByGain) {
    adjustCenters(in_frame, frame, options, centers);
  }
  for (int i = centers.k; i-- > 1;) {
    centers.sphere[i] = frame.axes * (centers.sphere[i] - centers.sphere[0]);
  }
  centers.sphere[0] = frame.axes * (frame.middle + centers.sphere[0]);
  return centers;
}

void requireUsable(const FitOptions& options) {
  constexpr double kLeast = 1.0 / 256, kHalfPi = 1.5707963267948966;
  if (options.angle >= kLeast && options.angle < kHalfPi) return;
  refuse("the angle of a fit must be in [1/256, pi/2), not ", options.angle, ".");
}

}  // namespace kios
