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
  const double at = n_[0].dot(bv.center0) + offset_[0],
               end = n_[1].dot(bv.center0) + offset_[1] + sagitta(bv.center0, bv.radius0);
  if (at + length_[0] * bv.radius0 <= limit.start && end + length_[1] * bv.radius0 <= limit.end) {
    return true;
  }
  const double unit = scaled(1.0, bv.exponent);
  for (int i = 0; i < bv.k() - 1; ++i) {
    const Vector3d cap(bv.cap_x[i] * unit, bv.cap_y[i] * unit, bv.cap_z[i] * unit);
    const double radius = bv.cap_r[i] * unit;
    if (at + n_[0].dot(cap) + length_[0] * radius <= limit.start &&
        end + n_[1].dot(cap) + length_[1] * radius <= limit.end) {
      return true;
    }
  }
  return below(model, entry.leftChild(), limit, nodes_left) &&
         below(model, entry.rightChild(), limit, nodes_left);
}

}  // namespace kios::continuous
