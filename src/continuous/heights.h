// SPDX-FileCopyrightText: 2026 The fcl_kios authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "continuous/velocity_field.h"
#include "fcl_kios/model/model.h"

namespace kios::continuous {

/// Says how high the points of a moving body lie along a direction n, at the start of a time and at
/// its end. Between them a point lies at most as high as on the line between both heights, since
/// that at the end takes the largest acceleration along n for granted all the time.
class Heights {
 public:
  /// n is of length 1, and it and the velocities are in one frame, in which the body lies at R, T.
  Heights(const VelocityField& field, const Eigen::Matrix3d& R, const Eigen::Vector3d& T,
          const Eigen::Vector3d& n, double duration);

  struct Height {
    double start, end;
  };
  /// Returns the height of a point of the body, in its own frame.
  Height of(const Eigen::Vector3d& y) const {
    return {n_[0].dot(y) + offset_[0], n_[1].dot(y) + offset_[1] + sagitta(y, 0)};
  }
  /// Returns true if all triangles under a node of the body's tree are proven to stay as low, at
  /// the start and at the end. Gives up after `nodes_left` nodes, which is then 0 or less.
  bool below(const Modeld& model, int node, const Height& limit, int& nodes_left) const;

 private:
  double sagitta(const Eigen::Vector3d& y, double radius) const {
    if (!accelerates_) return 0;
    return half_square_ * field_.accelerationAlong(direction_, R_ * y + T_, radius);
  }

  const VelocityField& field_;
  const Eigen::Matrix3d& R_;
  const Eigen::Vector3d& T_;
  const Eigen::Vector3d direction_;
  Eigen::Vector3d n_[2];  // in the body's frame
  double length_[2], offset_[2];
  double half_square_;
  bool accelerates_;
};

}  // namespace kios::continuous
