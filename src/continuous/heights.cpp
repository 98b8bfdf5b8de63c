// SPDX-FileCopyrightText: 2026 The fcl_kios authors
// SPDX-License-Identifier: BSD-3-Clause
#include "continuous/heights.h"

#include "volume/balls.h"

namespace kios::continuous {

using Eigen::Vector3d;

// n (w x r) = (n x w) r
Heights::Heights(const VelocityField& field, const Eigen::Matrix3d& R, const Vector3d& T,
                 const Vector3d& n, double duration)
    : field_(field),
      R_(R),
      T_(T),
      direction_(n),
      half_square_(0.5 * duration * duration * (1 + 0x1p-48)),
      accelerates_(field.turn_acceleration > 0 || field.originAcceleration() > 0) {
  const Vector3d turn = n.cross(field.angular), last = n + duration * turn;
  n_[0].noalias() = R.transpose() * n;
  n_[1].noalias() = R.transpose() * last;
  offset_[0] = n.dot(T);
  offset_[1] = last.dot(T) + duration * (n.dot(field.linear) - turn.dot(field.origin));
  for (int i = 0; i < 2; ++i) length_[i] = n_[i].norm() * (1 + 0x1p-48);
}

bool Heights::below(const Modeld& model, int node, const Height& limit, int& nodes_left) const {
  if (--nodes_left <= 0) return false;
  const auto& entry = model.getBV(node);
  if (entry.isLeaf()) {
    const fcl::Triangle& t = model.tri_indices[entry.primitiveId()];
    for (int k = 0; k < 3; ++k) {
      const Height height = of(model.vertices[t[k]]);
      if (!(height.start <= limit.start && height.end <= limit.end)) return false;
    }
    return true;
  }
  const kIOSd& bv = entry.bv;
  Ball balls[kIOSd::kMaxSpheres];
  const int k = toBalls(bv, {bv.center0[0], bv.center0[1], bv.center0[2]}, 0, balls);
  const double leaves = sagitta(bv.center0, bv.radius0);
  for (int i = 0; i < k; ++i) {
    const Vector3d center(balls[i].x, balls[i].y, balls[i].z);
    if (n_[0].dot(center) + offset_[0] + length_[0] * balls[i].r <= limit.start &&
        n_[1].dot(center) + offset_[1] + leaves + length_[1] * balls[i].r <= limit.end) {
      return true;
    }
  }
  return below(model, entry.leftChild(), limit, nodes_left) &&
         below(model, entry.rightChild(), limit, nodes_left);
}

}  // namespace kios::continuous
