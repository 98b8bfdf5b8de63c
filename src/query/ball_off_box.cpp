// SPDX-FileCopyrightText: 2026 The fcl_kios authors
// SPDX-License-Identifier: BSD-3-Clause
#include "query/ball_off_box.h"

#include "model/prepared.h"
#include "search/double_bound.h"
#include "volume/instantiate.h"

namespace kios {
namespace {

// The ball's centre in the tree's frame is as exact as CentralWay's lengths.
template <typename S>
bool isOff(const Model<S>& boxed, const fcl::Transform3<S>& X_WB, double radius,
           const fcl::Vector3d& way, double lengths, double margin) {
  engine::TreeRoot root;
  if (!copyRoot(boxed, root)) return false;
  const Eigen::Map<const fcl::Vector3d> origin(root.origin);
  const fcl::Vector3<S>& center = boxed.getBV(0).bv.center0;
  const fcl::Vector3d in_box = X_WB.linear().template cast<double>().transpose() * way +
                               (center.template cast<double>() - origin);
  const double slack = CentralWay::kSlack<S> * (lengths + margin + origin.template lpNorm<1>());
  return engine::boxBound(root.root_box, in_box) > radius + margin + slack;
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
