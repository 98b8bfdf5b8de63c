// SPDX-FileCopyrightText: 2026 The fcl_kios authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <Eigen/Core>
#include <cstddef>
#include <cstdint>
#include <functional>
#include <utility>
#include <vector>

#include "fcl_kios/points.h"
#include "fcl_kios/triangle.h"

namespace kios {

/// Throws std::invalid_argument, naming the column, if a coordinate is not finite or too large.
void requireValidPoint(const Pointd& p, Eigen::Index column);

/// The points of a query, in the model's frame.
class PointBatch {
 public:
  /// Throws std::invalid_argument if a point, the pose or another part of the request is none. The
  /// arrays must outlive it.
  PointBatch(const Eigen::Ref<const Eigen::Matrix3Xd>& points, const PointRequest& request);

  /// Throws std::invalid_argument unless an array has as many entries as there are points.
  void requireSize(Eigen::Index size, const char* array) const;

  /// Rounds as PointRequest says.
  Pointd inModel(Eigen::Index column) const;
  Pointd toPoints(const Pointd& p_M) const;

  /// Looks at one point, by its column.
  using Look = std::function<void(Eigen::Index column)>;
  /// Shares the points among threads, fewer if not all can start, each of which looks at its own by
  /// a Look of its own, along a Morton curve: each point is near the one before. What a Look throws
  /// is thrown again.
  void forAll(const std::function<Look()>& make_look) const;

 private:
  /// Codes and columns, sorted.
  std::vector<std::pair<std::uint64_t, Eigen::Index>> alongCurve() const;

  const Eigen::Ref<const Eigen::Matrix3Xd>& points_;
  fcl::Transform3d X_WM_;
  Eigen::Matrix3d inverse_;
  std::size_t num_threads_;
};

}  // namespace kios
