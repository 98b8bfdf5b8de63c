// SPDX-FileCopyrightText: 2026 The fcl_kios authors
// SPDX-License-Identifier: BSD-3-Clause
#include "build/ellipsoid_frame.h"

#include "build/enclosing_ellipsoid.h"

namespace kios {

PrincipalFrame ellipsoidFrame(const PointLanes& points, PointLanes& in_frame,
                              const PrincipalFrame& principal) {
  constexpr double kTolerance = 1e-3;  // the volume is within 0.15 % of the least
  const EnclosingEllipsoid ellipsoid = smallestEllipsoid(in_frame, kTolerance);
  const Eigen::Matrix3d axes = principal.axes.cast<double>() * ellipsoid.axes;
  const Eigen::Vector3d middle =
      ellipsoid.axes.transpose() *
      (ellipsoid.center +
       Eigen::Vector3d(principal.middle[0], principal.middle[1], principal.middle[2]));

  PrincipalFrame frame;
  frame.axes = axes.cast<float>();
  for (int k = 0; k < 3; ++k) {
    frame.middle[k] = static_cast<float>(middle[k]);
    frame.half[k] = static_cast<float>(ellipsoid.half[k]);
    frame.order[k] = k;
  }
  in_frame.resize(points.size());
  float* const out[3] = {in_frame.x(), in_frame.y(), in_frame.z()};
  for (int i = 0; i < points.paddedSize(); ++i) {
    const Eigen::Vector3f p(points.x()[i], points.y()[i], points.z()[i]);
    for (int k = 0; k < 3; ++k) out[k][i] = frame.axes.col(k).dot(p) - frame.middle[k];
  }
  return frame;
}

}  // namespace kios
