// SPDX-FileCopyrightText: 2026 The fcl_kios authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cmath>
#include <cstddef>

#include <fcl/geometry/bvh/BV_node.h>
#include "build/lane_fit.h"
#include "build/mesh_view.h"
#include "fcl_kios/volume.h"
#include "volume/rounding.h"

namespace kios::engine {

/// Holds the origin and the unit of points that are stored as floats q: p = origin + 2^exponent q.
struct PointFrame {
  double origin[3] = {};
  double to_frame = 1, to_model = 1;  ///< 2^-exponent, 2^exponent

  void setExponent(int exponent) {
    to_frame = std::ldexp(1.0, -exponent);
    to_model = std::ldexp(1.0, exponent);
  }

  /// Returns p in the frame as x, y, z, 0: rounded once, to floats, but for the double differences.
  template <typename S>
  lanes::Float4 place(const fcl::Vector3<S>& p) const {
    const auto at = [&](int c) { return roundedTo<float>((p[c] - origin[c]) * to_frame); };
    return lanes::Float4{at(0), at(1), at(2), 0};
  }
};

/// A volume of a mesh's binary tree and its place in it, as FCL stores them.
template <typename S>
using VolumeNode = fcl::BVNode<kIOS<S>>;

/// The content of a small node, which decides how it is fitted.
enum class SmallNode {
  kPart,    ///< triangles, each with its three corners
  kPoints,  ///< several triangles that are points
  kCluster  ///< one or a few leaves of the prepared tree, the points of each once
};

/// Fits the volumes of a tree's nodes, to points as floats in some frame: every sphere contains the
/// node's vertices in exact arithmetic. A node too small for its frame is fitted to the vertices
/// themselves.
template <typename S>
class VolumeFit {
 public:
  /// `primitives` holds the triangles of a node from its first_primitive on, when the node is
  /// fitted.
  VolumeFit(const MeshView<S>& mesh, VolumeNode<S>* nodes, const unsigned int* primitives)
      : mesh_(mesh), nodes_(nodes), primitives_(primitives) {}

  /// The frame of what follows; `reach` bounds all coordinates in it. Small nodes that wait are to
  /// be finished first.
  void setFrame(const PointFrame& frame, float reach) {
    frame_ = frame;
    reach_ = reach;
  }

  /// Takes a node of few points, to be fitted with three others. Of each quad the first three
  /// points count, the first of triangles that are points, those of a cluster all.
  void addSmall(int node, SmallNode content, const PointQuad* quads, int n);
  void finishSmall();

  /// Fits a node of one triangle that is a point.
  void fitPoint(int node);

  /// Places spheres by all points, of PointRows::kMost quads at most.
  void fit(int node, const PointQuad* quads, std::size_t n);

  /// Places spheres by the extreme points of the node's two children; returns the node's.
  Extremes fit(int node, const Extremes (&parts)[2], const PointQuad* quads, std::size_t n);

 private:
  /// Four nodes of about as many points.
  struct Batch {
    int used = 0;
    int nodes[4] = {};
    PointRows rows;
  };
  /// Rows that the sets of each batch have: of one triangle or up to three points, then of more of
  /// them, then of clusters.
  static constexpr int kBatches = 12, kClusters = 7;
  static constexpr int kRoom[kBatches] = {3, 4, 6, 9, 12, 18, 24, 8, 12, 16, 24, 32};

  void fitBatch(int which);
  void fit(int node, const PointRows& rows, const PointQuad* quads, std::size_t n);
  void storeCenter(int node, int lane, SphereSites& sites) const;
  void complete(int node, int lane, const SphereSites& sites, const FarthestSquares& far);
  void fitToVertices(int node);

  const MeshView<S> mesh_;
  VolumeNode<S>* const nodes_;
  const unsigned int* const primitives_;
  PointFrame frame_;
  float reach_ = 0;
  Batch batches_[kBatches];
};

}  // namespace kios::engine
