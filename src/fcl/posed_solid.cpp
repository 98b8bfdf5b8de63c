// SPDX-FileCopyrightText: 2026 The fcl_kios authors
// SPDX-License-Identifier: BSD-3-Clause
#include "fcl/posed_solid.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

#include "bv/balls.h"
#include "fcl_kios/bv/separation.h"

namespace kios {
namespace {

void scaleBy(double factor, shape::Solid& solid) {
  solid.half *= factor;
  solid.radius *= factor;
  solid.half_length *= factor;
  solid.offset *= factor;
  for (shape::Vec& p : solid.points) p *= factor;
}

}  // namespace

template <typename S>
PosedSolid<S>::PosedSolid(shape::Solid solid, const fcl::Transform3<S>& X_WM,
                          const fcl::Transform3<S>& X_WS, const kIOS<S>& root)
    : solid_(std::move(solid)),
      stretch_(RelativePose<S>(X_WS, X_WM).stretch) {  // checks both poses
  R_WS_ = X_WS.linear().template cast<double>();
  t_WS_ = X_WS.translation().template cast<double>();
  R_ = R_WS_.transpose() * X_WM.linear().template cast<double>();
  T_ = R_WS_.transpose() * (X_WM.translation().template cast<double>() - t_WS_);
  const double largest =
      std::max({solid_.reach(), T_.lpNorm<Eigen::Infinity>(),
                double{root.center0.template lpNorm<Eigen::Infinity>()}, double{root.radius0}});
  constexpr int kPlain = 100;
  const int exponent = largest > 0 ? std::ilogb(largest) : 0;
  if (std::abs(exponent) > kPlain) {
    per_unit_ = std::ldexp(1.0, -exponent);
    unit_ = std::ldexp(1.0, exponent);
    scaleBy(per_unit_, solid_);
    T_ *= per_unit_;
  }
  offsets_ = T_.lpNorm<1>() + solid_.reach();
}

template <typename S>
S PosedSolid<S>::fromUnits(double length) const {
  const double value = length * unit_;
  if (!(length > 0)) return S(0);
  return std::max(static_cast<S>(value), std::numeric_limits<S>::denorm_min());
}

template <typename S>
fcl::Vector3<S> PosedSolid<S>::toWorld(const shape::Vec& p) const {
  return (R_WS_ * (p * unit_) + t_WS_).template cast<S>();
}

template <typename S>
fcl::Vector3<S> PosedSolid<S>::directionToWorld(const shape::Vec& n) const {
  return (R_WS_ * n).normalized().template cast<S>();
}

// A posed centre takes 5 roundings a coordinate of terms that sum to at most 1.8 |c|_1 + |T|_1, as
// do the posed points of the content, with |x|_1 <= |c|_1 + 1.8 r. pointBound() and the triangle
// kernels add less than 2^-48 (|p|_1 + reach) and a few roundings of r. All that is below
// 2^-46 (1.8 |c|_1 + |T|_1 + reach + 4 r).
template <typename S>
double PosedSolid<S>::bound(const kIOS<S>& bv, double enough) const {
  const shape::Vec c_M = bv.center0.template cast<double>() * per_unit_;
  const shape::Vec c = R_ * c_M + T_;
  const double lengths = 1.8 * c_M.lpNorm<1>() + offsets_;
  const double r0 = bv.radius0 * per_unit_;
  double best = shape::pointBound(solid_, c) - r0 - (0x1p-46 * (lengths + 4 * r0) + stretch_ * r0);
  if (best > enough) return best;
  const double cap_unit = scaled(per_unit_, bv.exponent);
  const double reach = bv.reach * cap_unit;
  const double pad = 0x1p-46 * (lengths + 4 * reach) + stretch_ * reach;
  for (int i = 0; i + 1 < bv.k(); ++i) {
    const shape::Vec cap = shape::Vec(bv.cap_x[i], bv.cap_y[i], bv.cap_z[i]) * cap_unit;
    best = std::max(best, shape::pointBound(solid_, c + R_ * cap) - bv.cap_r[i] * cap_unit - pad);
  }
  return best;
}

template class PosedSolid<double>;
template class PosedSolid<float>;

}  // namespace kios
