// SPDX-FileCopyrightText: 2026 The fcl_kios authors
// SPDX-License-Identifier: BSD-3-Clause
#include "query/ball_off_box.h"

#include <cmath>

#include "model/prepared.h"
#include "volume/error_bounds.h"
#include "volume/instantiate.h"
#include "volume/lanes.h"

namespace kios {
namespace {

using lanes::Float4;

// v, from the box's centre to the ball's, is as exact as CentralWay's lengths before it is rounded
// to floats. With S = reach + r + margin + |v|_1, along a stored axis of length 1 + 4 u at most, u
// = 2^-24: vertices are off by 2 u reach, v and its products by 11 u |v|_1, the radius by 4 u r,
// and the sum of halves and pads rounds by 4 u S. boxError() allows for 128 u S.
template <typename S>
bool isOff(const Model<S>& boxed, const fcl::Transform3<S>& X_WB, double radius,
           const fcl::Vector3d& way, double lengths, double margin) {
  engine::TreeRoot root;
  if (!copyRoot(boxed, root)) return false;
  const engine::Box& box = root.root_box;
  const fcl::Vector3d in_box = X_WB.linear().template cast<double>().transpose() * way;
  const fcl::Vector3<S>& center = boxed.getBV(0).bv.center0;
  double v[3], norm1 = 0, origin1 = 0;
  const float box_center[3] = {box.x[engine::kCenter], box.y[engine::kCenter],
                               box.z[engine::kCenter]};
  for (int i = 0; i < 3; ++i) {
    v[i] = in_box[i] + ((double{center[i]} - root.origin[i]) - double{box_center[i]});
    norm1 += std::abs(v[i]);
    origin1 += std::abs(root.origin[i]);
  }
  const double out = radius + margin + CentralWay::kSlack<S> * (lengths + margin + origin1) +
                     error_bounds::boxError(double{root.reach} + radius + margin + norm1);
  const Float4 along = static_cast<float>(v[0]) * lanes::load(box.x) +
                       static_cast<float>(v[1]) * lanes::load(box.y) +
                       static_cast<float>(v[2]) * lanes::load(box.z);
  const Float4 gaps = lanes::abs(along) - lanes::load(box.half);
  const float least = static_cast<float>(out);
  return gaps[0] > least || gaps[1] > least || gaps[2] > least;
}

}  // namespace

template <typename S>
[[gnu::hot]] bool ballOffBox(const Model<S>& a, const fcl::Transform3<S>& X_WA, const Model<S>& b,
                             const fcl::Transform3<S>& X_WB, const CentralWay& way,
                             double squared_errors, double margin) {
  const kIOS<S>&root_a = a.getBV(0).bv, &root_b = b.getBV(0).bv;
  const bool a_larger = root_a.radius0 > root_b.radius0;
  const kIOS<S>&larger = a_larger ? root_a : root_b, &smaller = a_larger ? root_b : root_a;
  if (isThin(smaller) || !(areUnlike(larger, smaller) || isThin(larger))) return false;
  if (!CentralWay::canProve<S>(way.lengths + margin, squared_errors)) return false;
  const fcl::Vector3d w(way.w[0], way.w[1], way.w[2]);
  return a_larger ? isOff(a, X_WA, double{root_b.radius0}, w, way.lengths, margin)
                  : isOff(b, X_WB, double{root_a.radius0}, fcl::Vector3d(-w), way.lengths, margin);
}

KIOS_INSTANTIATE_FUNCTION(ballOffBox);

}  // namespace kios
