// SPDX-FileCopyrightText: 2026 The fcl_kios authors
// SPDX-License-Identifier: BSD-3-Clause
#include "query/smaller_off_box.h"

#include <cmath>

#include "model/prepared.h"
#include "search/double_bound.h"
#include "volume/instantiate.h"
#include "volume/rounding.h"

namespace kios {
namespace {

fcl::Vector3d originOf(const engine::TreeRoot& root) {
  return Eigen::Map<const fcl::Vector3d>(root.origin);
}

/// The centre of the model's central sphere in its tree's frame.
template <typename S>
fcl::Vector3d centerOf(const Model<S>& model, const engine::TreeRoot& root) {
  return model.getBV(0).bv.center0.template cast<double>() - originOf(root);
}

// Along the axis of the larger box that faces it, of length 1 but for 2 u, u = 2^-24. The smaller
// box lies about the centre that was turned, so what is turned here is no longer than the lengths.
// Its axes are orthonormal but for 4 u: it reaches to the sum of |n . axis| h but for 8 u of h.
template <typename S>
bool isBoxOff(const engine::Box& box, const fcl::Matrix3d& R_WB, const Model<S>& smaller,
              const fcl::Transform3<S>& X_WS, const engine::OutOfBox& out, double lengths,
              double margin) {
  engine::TreeRoot root;
  if (!copyRoot(smaller, root)) return false;
  const engine::Box& other = root.root_box;
  const int axis = out.axis();
  const fcl::Vector3d n =
      X_WS.linear().template cast<double>().transpose() * (R_WB * engine::columnOf(box, axis));
  double reach = 0;
  for (int i = 0; i < 3; ++i) reach += std::abs(n.dot(engine::columnOf(other, i))) * other.half[i];
  const double offset = n.dot(engine::columnOf(other, engine::kCenter) - centerOf(smaller, root));
  const double gap = out.height + (out.along[axis] < 0 ? -offset : offset) - reach;
  const double slack = CentralWay::kSlack<S> * (lengths + originOf(root).template lpNorm<1>()) +
                       engine::kStored * (engine::extentOf(box) + 10 * engine::extentOf(other));
  return (1 - 4 * kUlpFloat) * gap > margin + slack;
}

// The centre of the smaller one's sphere is as exact in the frame of the larger one's tree as
// CentralWay's lengths.
template <typename S>
bool isOff(const Model<S>& larger, const fcl::Transform3<S>& X_WL, const Model<S>& smaller,
           const fcl::Transform3<S>& X_WS, const fcl::Vector3d& way, double lengths,
           double margin) {
  engine::TreeRoot root;
  if (!copyRoot(larger, root)) return false;
  const fcl::Matrix3d R = X_WL.linear().template cast<double>();
  const fcl::Vector3d center = R.transpose() * way + centerOf(larger, root);
  const kIOS<S>& ball = smaller.getBV(0).bv;
  lengths += margin + originOf(root).template lpNorm<1>();
  const double least = double{ball.radius0} + margin + CentralWay::kSlack<S> * lengths;
  const engine::OutOfBox out(root.root_box, center);
  if (engine::boxBound(root.root_box, center, out) > least) return true;
  return out.height > margin && areUnlike(larger.getBV(0).bv, ball) &&
         isBoxOff(root.root_box, R, smaller, X_WS, out, lengths, margin);
}

}  // namespace

template <typename S>
[[gnu::hot]] bool smallerOffBox(const Model<S>& a, const fcl::Transform3<S>& X_WA,
                                const Model<S>& b, const fcl::Transform3<S>& X_WB,
                                const CentralWay& way, double squared_errors, double margin) {
  const kIOS<S>&root_a = a.getBV(0).bv, &root_b = b.getBV(0).bv;
  const bool a_larger = root_a.radius0 > root_b.radius0;
  const kIOS<S>&larger = a_larger ? root_a : root_b, &smaller = a_larger ? root_b : root_a;
  if (!areUnlike(larger, smaller) && (isThin(smaller) || !isThin(larger))) return false;
  if (!CentralWay::canProve<S>(way.lengths + margin, squared_errors)) return false;
  const fcl::Vector3d w(way.w[0], way.w[1], way.w[2]);
  return a_larger ? isOff<S>(a, X_WA, b, X_WB, w, way.lengths, margin)
                  : isOff<S>(b, X_WB, a, X_WA, -w, way.lengths, margin);
}

KIOS_INSTANTIATE_FUNCTION(smallerOffBox);

}  // namespace kios
