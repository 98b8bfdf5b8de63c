// SPDX-FileCopyrightText: 2026 The fcl_kios authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <Eigen/Core>

#include "build/four_axes.h"
#include "tree/tree.h"

namespace kios::engine {

/// Eight points; those beyond the last repeat it.
struct PointChunk {
  Lanes x, y, z;
};

/// Number, mean and scatter of points: what principal axes need of them.
struct Moments {
  double n = 0;
  Eigen::Vector3d mean = Eigen::Vector3d::Zero();
  Scatter<double> scatter;  ///< about the mean

  void add(const Moments& o);
};

Moments momentsOf(const Eigen::Vector3f* points, int n);

/// Writes the least spheres of a node about five centres that hold all points, in exact arithmetic.
void encloseAll(const PointChunk* chunks, std::size_t num_chunks,
                const Eigen::Vector3f (&centers)[kSphereRows], Node& node);

/// Axes for the box of a node: along its caps, or where it has not enough of them the principal
/// axes of the points.
Eigen::Matrix3f axesOf(const Eigen::Vector3f (&centers)[kSphereRows], const PointChunk* chunks,
                       std::size_t num_chunks);

/// The box of points along orthonormal axes.
Box boxAround(const Eigen::Matrix3f& axes, const PointChunk* chunks, std::size_t num_chunks);

/// Fits spheres and box of a node to points: along the principal axes by moments, around the middle
/// of the box, in two passes. Less tight than kios::fit() by some percent, and several times as
/// fast. Every sphere (a cap is middle +- half, in exact arithmetic) and the box enclose the
/// points.
void momentFit(const PointChunk* chunks, std::size_t num_chunks, const Moments& moments, Node& node,
               Box* box);

}  // namespace kios::engine
