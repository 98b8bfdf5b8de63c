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

  /// The places of a fit's spheres: S0 in the model's frame, k - 1 caps relative to it.
  struct Placement {
    int k = 0;
    Eigen::Vector3d center0 = Eigen::Vector3d::Zero();
    Eigen::Vector3d cap[SphereCenters::kMost - 1];
  };
  /// As fit(), but at most `most` spheres (7 by the tuned fit alone) and no radii. n > 0.
  Placement placement(const fcl::Vector3<S>* points, int n, const FitOptions& options, int most);

 private:
  void loadRelative(const fcl::Vector3<S>* points, int n);
  /// Changes `frame` to the one that the centers are in.
  SphereCenters centersFor(PrincipalFrame& frame, const FitOptions& options, int most);
  kIOS<S> placed(const fcl::Vector3<S>* points, int n, const PrincipalFrame& frame,
                 const SphereCenters& centers) const;

  PointLanes relative_;  ///< points - points[0], in units of 2^exponent_
  PointLanes in_frame_;
  int exponent_ = 0;
};

/// Throws std::invalid_argument if the angle is not in [1/256, pi/2).
void requireUsable(const FitOptions& options);

}  // namespace kios
