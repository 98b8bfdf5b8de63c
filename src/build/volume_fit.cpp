// SPDX-FileCopyrightText: 2026 The fcl_kios authors
// SPDX-License-Identifier: BSD-3-Clause
#include "build/volume_fit.h"

#include <algorithm>
#include <cmath>
#include <vector>

#include "volume/assemble.h"

namespace kios::engine {

using lanes::Float4;

template <typename S>
void VolumeFit<S>::addSmall(int node, SmallNode content, const PointQuad* quads, int n) {
  const int of_each = content == SmallNode::kCluster ? 4 : 3;
  const int count = n * of_each;
  int which =
      content == SmallNode::kTriangle ? 0 : (content == SmallNode::kPart ? kParts : kClusters);
  while (count > kRoom[which]) ++which;
  Batch& batch = batches_[which];
  FourSets& sets = batch.sets;
  sets.count = batch.used == 0 ? count : std::max(sets.count, count);
  const int lane = batch.used;
  batch.nodes[lane] = node;
  int at = 0;
  for (int i = 0; i < n; ++i) {
    for (int k = 0; k < of_each; ++k, ++at) {
      sets.x[at][lane] = quads[i].x[k];
      sets.y[at][lane] = quads[i].y[k];
      sets.z[at][lane] = quads[i].z[k];
      sets.weight[at][lane] = 1;
    }
  }
  for (; at < kRoom[which]; ++at) {
    sets.x[at][lane] = quads[0].x[0];
    sets.y[at][lane] = quads[0].y[0];
    sets.z[at][lane] = quads[0].z[0];
    sets.weight[at][lane] = 0;
  }
  if (++batch.used == 4) fitBatch(which);
}

template <typename S>
void VolumeFit<S>::finishSmall() {
  for (int which = 0; which < kBatches; ++which) {
    Batch& batch = batches_[which];
    if (batch.used == 0) continue;
    for (int lane = batch.used; lane < 4; ++lane) {
      for (int i = 0; i < batch.sets.count; ++i) {
        for (Float4* const v : {batch.sets.x, batch.sets.y, batch.sets.z, batch.sets.weight}) {
          v[i][lane] = v[i][0];
        }
      }
    }
    fitBatch(which);
  }
}

template <typename S>
void VolumeFit<S>::fitBatch(int which) {
  Batch& batch = batches_[which];
  FourSites sites =
      which == 0 ? placeFourTriangles(batch.sets) : placeFour(batch.sets, which >= kClusters);
  for (int lane = 0; lane < batch.used; ++lane) {
    for (int c = 0; c < 3; ++c) {
      sites.center[c][lane] = storeCenter(sites.center[c][lane], c, nodes_[batch.nodes[lane]].bv);
    }
  }
  const FourSquares far = farthestSquares(batch.sets, sites);
  for (int lane = 0; lane < batch.used; ++lane) {
    SphereSites of_one;
    FarthestSquares squares;
    of_one.k = sites.k[lane];
    squares.s0 = far.s0[lane];
    for (int c = 0; c < 3; ++c) of_one.center[c] = sites.center[c][lane];
    for (int i = 0; i < 4; ++i) {
      for (int c = 0; c < 3; ++c) of_one.cap[c][i] = sites.cap[i][c][lane];
      squares.cap[i] = far.cap[i][lane];
    }
    complete(batch.nodes[lane], of_one, squares);
  }
  batch.used = 0;
}

template <typename S>
void VolumeFit<S>::fit(int node, const PointQuad* quads, std::size_t n) {
  const float first[3] = {quads[0].x[0], quads[0].y[0], quads[0].z[0]};
  points_.resize(static_cast<int>(4 * n));
  for (std::size_t i = 0; i < n; ++i) {
    lanes::store(points_.x() + 4 * i, quads[i].x - first[0]);
    lanes::store(points_.y() + 4 * i, quads[i].y - first[1]);
    lanes::store(points_.z() + 4 * i, quads[i].z - first[2]);
  }
  place(node, placeTuned(points_, first, scratch_), quads, n);
}

template <typename S>
Extremes VolumeFit<S>::fit(int node, const Extremes& left, const Extremes& right,
                           const PointQuad* quads, std::size_t n) {
  const float first[3] = {left.x[0], left.y[0], left.z[0]};
  points_.resize(left.count + right.count);
  int count = 0;
  for (const Extremes* const of : {&left, &right}) {
    for (int i = 0; i < of->count; ++i) {
      points_.set(count++, of->x[i] - first[0], of->y[i] - first[1], of->z[i] - first[2]);
    }
  }
  points_.pad();
  place(node, placeTuned(points_, first, scratch_), quads, n);
  PointQuad both[Extremes::kMost / 2];
  const int padded = points_.paddedSize();
  for (int i = 0; i < padded; i += 4) {
    both[i / 4] =
        PointQuad{lanes::load(points_.x() + i) + first[0], lanes::load(points_.y() + i) + first[1],
                  lanes::load(points_.z() + i) + first[2]};
  }
  return extremesOf(both, static_cast<std::size_t>(padded / 4));
}

/// Stores a coordinate of S0's centre; returns it in the frame as it was stored.
template <typename S>
float VolumeFit<S>::storeCenter(float center, int c, kIOS<S>& bv) const {
  bv.center0[c] = static_cast<S>(frame_.origin[c] + center * frame_.to_model);
  return static_cast<float>((bv.center0[c] - frame_.origin[c]) * frame_.to_frame);
}

template <typename S>
void VolumeFit<S>::place(int node, SphereSites sites, const PointQuad* quads, std::size_t n) {
  for (int c = 0; c < 3; ++c) {
    sites.center[c] = storeCenter(sites.center[c], c, nodes_[node].bv);
  }
  complete(node, sites, farthestSquares(quads, n, sites));
}

/// Writes the radii. With u = 2^-24: a distance as computed has 4.5 roundings. A point is off by u
/// of each coordinate, in all by sqrt(3) u reach; S0's centre in the frame by sqrt(3) u |centre|,
/// where |.| is the largest coordinate; what is subtracted for a cap in two steps rounds at the
/// first by sqrt(3) u (reach + |centre|) at most. Radii of caps get twice of that, for they are
/// added up in floats.
template <typename S>
void VolumeFit<S>::complete(int node, const SphereSites& sites, const FarthestSquares& far) {
  kIOS<S>& bv = nodes_[node].bv;
  const float at = reach_ + std::max({std::abs(sites.center[0]), std::abs(sites.center[1]),
                                      std::abs(sites.center[2])});
  const double r0 = std::sqrt(double{far.s0}) * (1 + 8 * kUlpFloat) + 0x1p-22 * double{at};
  if (r0 < 0x1p-10 * double{at}) {  // the pad would be a part of 1e-3 or more
    fitToVertices(node);
    return;
  }
  bv.radius0 = roundUp<S>(r0 * frame_.to_model);
  bv.exponent = static_cast<std::int16_t>(capExponent(bv.radius0));
  const auto to_cap_units = static_cast<float>(scaled(frame_.to_model, -bv.exponent));
  const Float4(&cap)[3] = sites.cap;
  const Float4 most =
      lanes::max(lanes::max(lanes::abs(cap[0]), lanes::abs(cap[1])), lanes::abs(cap[2]));
  const Float4 radius = lanes::sqrt(far.cap) * (1 + 0x1p-20F) + 0x1p-21F * (2 * at + most);
  lanes::store(bv.cap_x, cap[0] * to_cap_units);
  lanes::store(bv.cap_y, cap[1] * to_cap_units);
  lanes::store(bv.cap_z, cap[2] * to_cap_units);
  lanes::store(bv.cap_r, radius * to_cap_units);
  completeCaps(bv, far.s0 > 0 ? sites.k : 1);
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
  node.bv = fitter_.fit(vertices.data(), static_cast<int>(vertices.size()), FitMethod::kTuned);
}

template class VolumeFit<double>;
template class VolumeFit<float>;

}  // namespace kios::engine
