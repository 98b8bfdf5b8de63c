// SPDX-FileCopyrightText: 2026 The fcl_kios authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "build/point_lanes.h"
#include "build/principal_frame.h"
#include "build/sphere_centers.h"
#include "fcl_kios/build/fit.h"

namespace kios {

/// Fits kIOS to point sets and keeps its buffers from one fit to the next.
template <typename S>
class SphereFitter {
 public:
  /// The results of a node's fit that its split needs: the box centre and the longest axis, in the
  /// model, and all principal axes, in no order.
  struct Split {
    Eigen::Vector3d center;
    Eigen::Vector3d axis;
    Eigen::Matrix3f axes;
  };

  /// Throws std::invalid_argument unless every coordinate is finite and below kMaxCoordinate<S>.
  kIOS<S> fit(const fcl::Vector3<S>* points, int n, const FitOptions& options,
              Split* split = nullptr);

  /// Places at most `most` spheres (7 by the tuned fit alone) as fit() does: in the points' axes
  /// and units of 2^exponent(), the first relative to points[0], the others to the first. n > 0.
  SphereCenters place(const fcl::Vector3<S>* points, int n, const FitOptions& options, int most,
                      Split* split = nullptr);
  int exponent() const { return exponent_; }

 private:
  void loadRelative(const fcl::Vector3<S>* points, int n);

  PointLanes relative_;  ///< points - points[0], in units of 2^exponent_
  PointLanes in_frame_;
  int exponent_ = 0;
};

/// Throws std::invalid_argument if the angle is not in [1/256, pi/2).
void requireUsable(const FitOptions& options);

}  // namespace kios
