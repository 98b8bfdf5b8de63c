// SPDX-FileCopyrightText: 2026 The fcl_kios authors
// SPDX-License-Identifier: BSD-3-Clause
#include "solid/support_point.h"

#include <algorithm>
#include <cmath>

#include "fcl_kios/volume/rigid.h"
#include "model/walk.h"
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
SupportPoint supportPoint(const Model<S>& model, const fcl::Vector3d& n) {
  const double length = n.norm();
  SupportPoint best = {-1, -kInfinity};
  const auto bounded = [&](int node) {
    return BoundedNode{-heightOf(model.getBV(node).bv, n, length), node};
  };
  const auto skip = [&best](const BoundedNode& at) { return !(-at.bound > best.height); };
  walkNearestFirst(BoundedNode{-kInfinity, 0}, skip, [&](const BoundedNode& at, const auto& add) {
    const auto& node = model.getBV(at.node);
    if (!node.isLeaf()) {
      add(bounded(node.leftChild()));
      add(bounded(node.rightChild()));
      return false;
    }
    const fcl::Triangle& ids = model.tri_indices[node.primitiveId()];
    for (int k = 0; k < 3; ++k) {
      const double height = detail::dot<double>(n, model.vertices[ids[k]].template cast<double>());
      if (height > best.height) best = {static_cast<int>(ids[k]), height};
    }
    return false;
  });
  return best;
}

template SupportPoint supportPoint(const Model<double>&, const fcl::Vector3d&);
template SupportPoint supportPoint(const Model<float>&, const fcl::Vector3d&);

}  // namespace kios
