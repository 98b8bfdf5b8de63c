// SPDX-FileCopyrightText: 2026 The fcl_kios authors
// SPDX-License-Identifier: BSD-3-Clause
#include "solid/extent_along.h"

#include <algorithm>
#include <cmath>
#include <utility>
#include <vector>

#include "fcl_kios/volume/rigid.h"
#include "volume/balls.h"
#include "volume/rounding.h"

namespace kios {
namespace {

/// Upper bound of n . x for the content, but for rounding.
template <typename S>
double heightOf(const kIOS<S>& bv, const fcl::Vector3d& n, double length) {
  const fcl::Vector3d center = bv.center0.template cast<double>();
  const double middle = detail::dot(n, center);
  double height = middle + length * double{bv.radius0};
  // Caps that k doesn't count repeat the first sphere.
  using Caps = Eigen::Array<float, kIOS<S>::kCaps, 1>;
  const auto at = [](const float* v) { return Eigen::Map<const Caps>(v).template cast<double>(); };
  const auto cap = n[0] * at(bv.cap_x) + n[1] * at(bv.cap_y) + n[2] * at(bv.cap_z);
  const double unit = scaled(1, bv.exponent);
  height = std::min(height, middle + unit * (cap + length * at(bv.cap_r)).minCoeff());
  return height;
}

}  // namespace

template <typename S>
FarthestVertex farthestAlong(const Model<S>& model, const fcl::Vector3d& n) {
  const double length = n.norm();
  FarthestVertex best = {-1, -kInfinity};
  struct Waiting {
    double height;
    int node;
  };
  std::vector<Waiting> waiting;
  waiting.reserve(64);
  waiting.push_back({kInfinity, 0});
  while (!waiting.empty()) {
    const Waiting at = waiting.back();
    waiting.pop_back();
    if (at.height <= best.height) continue;
    const auto& node = model.getBV(at.node);
    if (node.isLeaf()) {
      const fcl::Triangle& ids = model.tri_indices[node.primitiveId()];
      for (int k = 0; k < 3; ++k) {
        const double height =
            detail::dot<double>(n, model.vertices[ids[k]].template cast<double>());
        if (height > best.height) best = {static_cast<int>(ids[k]), height};
      }
      continue;
    }
    Waiting low = {heightOf(model.getBV(node.leftChild()).bv, n, length), node.leftChild()};
    Waiting high = {heightOf(model.getBV(node.rightChild()).bv, n, length), node.rightChild()};
    if (low.height > high.height) std::swap(low, high);
    if (low.height > best.height) waiting.push_back(low);
    if (high.height > best.height) waiting.push_back(high);
  }
  return best;
}

template FarthestVertex farthestAlong(const Model<double>&, const fcl::Vector3d&);
template FarthestVertex farthestAlong(const Model<float>&, const fcl::Vector3d&);

}  // namespace kios
