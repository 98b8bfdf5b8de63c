// SPDX-FileCopyrightText: 2026 The fcl_kios authors
// SPDX-License-Identifier: BSD-3-Clause
#include "build/volume_fit.h"

#include <algorithm>
#include <cmath>
#include <vector>

#include "fcl_kios/volume.h"
#include "volume/assemble.h"
#include "volume/rounding.h"

namespace kios::engine {

using lanes::Float4;

template <typename S>
void VolumeFit<S>::addSmall(int node, SmallNode content, const PointQuad* quads, int n) {
  const int of_each = content == SmallNode::kCluster ? 4 : (content == SmallNode::kPoints ? 1 : 3);
  const int count = std::max(n * of_each, 3);  // two points are a triangle without height
  int which = content == SmallNode::kCluster ? kClusters : 0;
  while (count > kRoom[which]) ++which;
  Batch& batch = batches_[which];
  PointRows& rows = batch.rows;
  rows.count = batch.used == 0 ? count : std::max(rows.count, count);
  const int lane = batch.used;
  batch.nodes[lane] = node;
  for (int row = 0; row < kRoom[which]; ++row) {
    const bool own = row < n * of_each;
    const PointQuad& from = quads[own ? row / of_each : 0];
    const int k = own ? row % of_each : 0;
    rows.set(row, lane, from.x[k], from.y[k], from.z[k], own ? 1 : 0);
  }
  if (++batch.used == 4) fitBatch(which);
}

template <typename S>
void VolumeFit<S>::finishSmall() {
  for (int which = 0; which < kBatches; ++which) {
    Batch& batch = batches_[which];
    if (batch.used == 0) continue;
    for (int lane = batch.used; lane < 4; ++lane) {
      for (int i = 0; i < batch.rows.count; ++i) {
        const PointQuad& p = batch.rows.points[i];
        batch.rows.set(i, lane, p.x[0], p.y[0], p.z[0], batch.rows.weight[i][0]);
      }
    }
    fitBatch(which);
  }
}

template <typename S>
void VolumeFit<S>::fitPoint(int node) {
  kIOS<S>& bv = nodes_[node].bv;
  bv.center0 = mesh_.corner(primitives_[nodes_[node].first_primitive], 0);
  completeCaps(bv, 1);
}

template <typename S>
void VolumeFit<S>::fitBatch(int which) {
  Batch& batch = batches_[which];
  const PointRows& rows = batch.rows;
  SphereSites sites =
      which == 0 ? placeTriangles(rows)
                 : placeSpheres(rows, which >= kClusters ? Sets::kFourThoroughly : Sets::kFour);
  for (int lane = 0; lane < batch.used; ++lane) storeCenter(batch.nodes[lane], lane, sites);
  const auto n = static_cast<std::size_t>(rows.count);
  const FarthestSquares far = farthestSquares(rows.points, n, sites);
  for (int lane = 0; lane < batch.used; ++lane) complete(batch.nodes[lane], lane, sites, far);
  batch.used = 0;
}

template <typename S>
void VolumeFit<S>::fit(int node, const PointQuad* quads, std::size_t n) {
  PointRows rows;
  rows.count = static_cast<int>(n);
  std::copy_n(quads, n, rows.points);
  std::fill_n(rows.weight, n, lanes::broadcast(1));
  fit(node, rows, quads, n);
}

template <typename S>
Extremes VolumeFit<S>::fit(int node, const Extremes (&parts)[2], const PointQuad* quads,
                           std::size_t n) {
  const PointRows rows = rowsOf(parts, 2);
  fit(node, rows, quads, n);
  return extremesOf(rows.points, static_cast<std::size_t>(rows.count));
}

/// Places spheres by one set, and measures them by all of its points.
template <typename S>
void VolumeFit<S>::fit(int node, const PointRows& rows, const PointQuad* quads, std::size_t n) {
  SphereSites sites = placeSpheres(rows, Sets::kOne);
  storeCenter(node, 0, sites);
  for (Float4& c : sites.center) c = lanes::broadcast(c[0]);
  FarthestSquares far = farthestSquares(quads, n, sites);
  far.s0[0] = lanes::horizontalMax(far.s0);
  for (Float4& square : far.cap) square[0] = lanes::horizontalMax(square);
  complete(node, 0, sites, far);
}

/// Stores S0's centre, and replaces it by what was stored, in the frame.
template <typename S>
void VolumeFit<S>::storeCenter(int node, int lane, SphereSites& sites) const {
  fcl::Vector3<S>& center = nodes_[node].bv.center0;
  for (int c = 0; c < 3; ++c) {
    center[c] = roundedTo<S>(frame_.origin[c] + sites.center[c][lane] * frame_.to_model);
    sites.center[c][lane] = roundedTo<float>((center[c] - frame_.origin[c]) * frame_.to_frame);
  }
}

/// Writes the caps and the radii of one lane. With u = 2^-24: a distance as computed has 4.5
/// roundings. A point is off by u of each coordinate, in all by sqrt(3) u reach; S0's centre in the
/// frame by sqrt(3) u |centre|, where |.| is the largest coordinate; what is subtracted for a cap
/// in two steps rounds at the first by sqrt(3) u (reach + |centre|) at most. Radii of caps get
/// twice of that, for they are added up in floats.
template <typename S>
void VolumeFit<S>::complete(int node, int lane, const SphereSites& sites,
                            const FarthestSquares& far) {
  kIOS<S>& bv = nodes_[node].bv;
  const float at =
      reach_ + std::max({std::abs(sites.center[0][lane]), std::abs(sites.center[1][lane]),
                         std::abs(sites.center[2][lane])});
  const float square = far.s0[lane];
  const double r0 = std::sqrt(double{square}) * (1 + 8 * kUlpFloat) + 0x1p-22 * double{at};
  if (r0 < 0x1p-10 * double{at}) {  // the pad would be a part of 1e-3 or more
    fitToVertices(node);
    return;
  }
  bv.radius0 = roundUp<S>(r0 * frame_.to_model);
  bv.exponent = static_cast<std::int16_t>(capExponent(bv.radius0));
  const auto to_cap_units = roundedTo<float>(scaled(frame_.to_model, -bv.exponent));
  Float4 cap[3], squares;  // a cap a lane
  for (int i = 0; i < 4; ++i) {
    for (int c = 0; c < 3; ++c) cap[c][i] = sites.cap[i][c][lane];
    squares[i] = far.cap[i][lane];
  }
  const Float4 most =
      lanes::max(lanes::max(lanes::abs(cap[0]), lanes::abs(cap[1])), lanes::abs(cap[2]));
  const Float4 radius = lanes::sqrt(squares) * (1 + 0x1p-20F) + 0x1p-21F * (2 * at + most);
  lanes::store(bv.cap_x, cap[0] * to_cap_units);
  lanes::store(bv.cap_y, cap[1] * to_cap_units);
  lanes::store(bv.cap_z, cap[2] * to_cap_units);
  lanes::store(bv.cap_r, radius * to_cap_units);
  completeCaps(bv, square > 0 ? sites.k[lane] : 1);
}

template <typename S>
void VolumeFit<S>::fitToVertices(int index) {
  VolumeNode<S>& node = nodes_[index];
  std::vector<fcl::Vector3<S>> vertices;
  vertices.reserve(3 * static_cast<std::size_t>(node.num_primitives));
  for (int i = 0; i < node.num_primitives; ++i) {
    const unsigned int triangle = primitives_[node.first_primitive + i];
    for (std::size_t k = 0; k < 3; ++k) vertices.push_back(mesh_.corner(triangle, k));
  }
  kios::fit(vertices.data(), static_cast<int>(vertices.size()), node.bv);
}

template class VolumeFit<double>;
template class VolumeFit<float>;

}  // namespace kios::engine
