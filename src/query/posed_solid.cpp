// SPDX-FileCopyrightText: 2026 The fcl_kios authors
// SPDX-License-Identifier: BSD-3-Clause
#include "query/posed_solid.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

#include "volume/error_bounds.h"
#include "volume/rotation.h"
#include "volume/rounding.h"

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
    : PosedSolid(std::move(solid), X_WM, X_WS, root, squaredRotationErrors(X_WS, X_WM)) {}

template <typename S>
PosedSolid<S>::PosedSolid(shape::Solid solid, const fcl::Transform3<S>& X_WM,
                          const fcl::Transform3<S>& X_WS, const kIOS<S>& root,
                          double squared_errors)
    : solid_(std::move(solid)), stretch_(error_bounds::stretchOf<S>(squared_errors)) {
  R_WS_ = X_WS.linear().template cast<double>();
  t_WS_ = X_WS.translation().template cast<double>();
  R_ = R_WS_.transpose() * X_WM.linear().template cast<double>();
  T_ = R_WS_.transpose() * (X_WM.translation().template cast<double>() - t_WS_);
  if (!(T_.lpNorm<1>() <= kMaxCoordinate<S>)) refuseTranslations(X_WS, X_WM);
  reach_ = solid_.reach();
  const double largest =
      std::max({reach_, T_.lpNorm<Eigen::Infinity>(),
                double{root.center0.template lpNorm<Eigen::Infinity>()}, double{root.radius0}});
  constexpr int kPlain = 100;
  const int exponent = largest > 0 ? std::ilogb(largest) : 0;
  if (std::abs(exponent) > kPlain) {
    per_unit_ = std::ldexp(1.0, -exponent);
    unit_ = std::ldexp(1.0, exponent);
    scaleBy(per_unit_, solid_);
    T_ *= per_unit_;
    reach_ *= per_unit_;
  }
  offsets_ = T_.lpNorm<1>() + reach_;
  if (solid_.bounded()) range_ = shape::rangeOf(solid_);
  shape::makeRows(solid_);
}

template <typename S>
S PosedSolid<S>::fromUnits(double length) const {
  const double value = length * unit_;
  if (!(length > 0)) return S(0);
  return std::max(roundedTo<S>(value), std::numeric_limits<S>::denorm_min());
}

template <typename S>
fcl::Vector3<S> PosedSolid<S>::toWorld(const shape::Vec& p) const {
  return roundedTo<S>(R_WS_ * (p * unit_) + t_WS_);
}

template <typename S>
fcl::Vector3<S> PosedSolid<S>::directionToWorld(const shape::Vec& n) const {
  return roundedTo<S>((R_WS_ * n).normalized());
}

// Twice the worst of docs/shapes.md; that of convex shapes without faces is another.
template <typename S>
double PosedSolid<S>::kernelError(const kIOS<S>& root) const {
  const double extent =
      2 * (double{root.center0.template lpNorm<1>()} + double{root.radius0}) * per_unit_ + offsets_;
  const bool known = solid_.kind != shape::Kind::kConvex || solid_.num_faces > 0;
  return (known ? 0x1p-42 : 0x1p-29) * extent;
}

// A posed centre takes 5 roundings a coordinate of terms that sum to at most 1.8 |c|_1 + |T|_1, as
// do the posed points of the content, with |x|_1 <= |c|_1 + 1.8 r: solidError() of all these
// lengths.
template <typename S>
int PosedSolid<S>::placeSpheres(const kIOS<S>& bv, Ball* spheres) const {
  const shape::Vec c_M = bv.center0.template cast<double>() * per_unit_;
  const shape::Vec c = R_ * c_M + T_;
  const double lengths = 1.8 * c_M.lpNorm<1>() + offsets_;
  const auto grown = [&](double r, double reach) {
    return r + (error_bounds::solidError(lengths + 4 * reach) + stretch_ * reach);
  };
  const double r = bv.radius0 * per_unit_;
  spheres[0] = {c.x(), c.y(), c.z(), grown(r, r)};
  const double unit = scaled(per_unit_, bv.exponent), reach = bv.reach * unit;
  for (int i = 0; i + 1 < bv.k(); ++i) {
    const shape::Vec o = R_ * (shape::Vec(bv.cap_x[i], bv.cap_y[i], bv.cap_z[i]) * unit);
    spheres[i + 1] = {c.x() + o.x(), c.y() + o.y(), c.z() + o.z(),
                      grown(bv.cap_r[i] * unit, reach)};
  }
  return bv.k();
}

template class PosedSolid<double>;
template class PosedSolid<float>;

}  // namespace kios
