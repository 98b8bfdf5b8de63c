// SPDX-FileCopyrightText: 2026 The fcl_kios authors
// SPDX-License-Identifier: BSD-3-Clause
#include "fcl_kios/detail/bv_traits.h"

#include <algorithm>
#include <limits>

#include "volume/balls.h"
#include "volume/instantiate.h"
#include "volume/rounding.h"

namespace kios {
namespace {

/// Box around the intersection of bv's spheres along the columns of `axes`, in bv's frame: its
/// centre relative to S0's, along the axes, and its half extents.
template <typename S>
void boxAlong(const kIOS<S>& bv, const Eigen::Matrix3d& axes, Eigen::Vector3d& center,
              Eigen::Vector3d& half) {
  Ball balls[kIOS<S>::kMaxSpheres];
  const int k = toBalls(bv, {0, 0, 0}, 0, balls);
  for (int c = 0; c < 3; ++c) {
    double low = -kInfinity, high = -low;
    for (int i = 0; i < k; ++i) {
      const double h = axes.col(c).dot(Eigen::Vector3d(balls[i].x, balls[i].y, balls[i].z));
      low = std::max(low, h - balls[i].r);
      high = std::min(high, h + balls[i].r);
    }
    center[c] = 0.5 * (low + high);
    half[c] = std::max(0.0, 0.5 * (high - low));
  }
}

/// The box must grow by this pad, for its centre and axes are rounded to S, and a rotation that is
/// off by E = R^T R - I stretches the content by less than |E| of its size.
template <typename S>
S roundingPad(const kIOS<S>& bv, const fcl::Transform3<S>& X) {
  constexpr S kEps = std::numeric_limits<S>::epsilon();
  const S error =
      (X.linear().transpose() * X.linear() - fcl::Matrix3<S>::Identity()).norm() + 16 * kEps;
  return 16 * kEps * (bv.center0.cwiseAbs().sum() + X.translation().cwiseAbs().sum()) +
         8 * error * bv.radius0;
}

Eigen::Vector3d capAxis(const float* x, const float* y, const float* z, int i) {
  return Eigen::Vector3d(double{x[i]} - x[i + 1], double{y[i]} - y[i + 1], double{z[i]} - z[i + 1]);
}

}  // namespace

template <typename S>
fcl::OBB<S> toOBB(const kIOS<S>& bv, const fcl::Transform3<S>& X) {
  Eigen::Matrix3d axes = Eigen::Matrix3d::Identity();
  if (bv.k() >= 3) {
    const Eigen::Vector3d e2 = capAxis(bv.cap_x, bv.cap_y, bv.cap_z, 0);
    Eigen::Vector3d e1 =
        bv.k() == 5 ? capAxis(bv.cap_x, bv.cap_y, bv.cap_z, 2) : e2.unitOrthogonal();
    e1 -= e2.dot(e1) / e2.squaredNorm() * e2;
    if (e2.norm() > 0 && e1.norm() > 0) {
      axes.col(2) = e2.normalized();
      axes.col(1) = e1.normalized();
      axes.col(0) = axes.col(1).cross(axes.col(2));
    }
  }
  Eigen::Vector3d center, half;
  boxAlong(bv, axes, center, half);
  fcl::OBB<S> obb;
  obb.axis = X.linear() * roundedTo<S>(axes);
  obb.To = X * fcl::Vector3<S>(bv.center0 + roundedTo<S>(axes * center));
  obb.extent = roundedTo<S>(half) + fcl::Vector3<S>::Constant(roundingPad(bv, X));
  return obb;
}

template <typename S>
fcl::AABB<S> toAABB(const kIOS<S>& bv, const fcl::Transform3<S>& X) {
  Eigen::Vector3d center, half;
  const Eigen::Matrix3d axes = X.linear().transpose().template cast<double>();
  boxAlong(bv, axes, center, half);
  const fcl::Vector3<S> middle = X * bv.center0 + roundedTo<S>(center);
  const fcl::Vector3<S> extent = roundedTo<S>(half) + fcl::Vector3<S>::Constant(roundingPad(bv, X));
  return fcl::AABB<S>(middle - extent, middle + extent);
}

KIOS_INSTANTIATE_FUNCTION(toOBB);
KIOS_INSTANTIATE_FUNCTION(toAABB);

}  // namespace kios
