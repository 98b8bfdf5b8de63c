// SPDX-FileCopyrightText: 2026 The fcl_kios authors
// SPDX-License-Identifier: BSD-3-Clause
#include "query/posed_solid.h"

#include <algorithm>
#include <cmath>
#include <limits>

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

void PosedSolid::setUnit(const Mesh& mesh) {
  T_ = X_SM_.T();
  reach_ = solid_.reach();
  const double largest = std::max({reach_, T_.lpNorm<Eigen::Infinity>(), mesh.largest()});
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

double PosedSolid::fromUnits(double length) const {
  return length > 0 ? std::max(length * unit_, std::numeric_limits<double>::denorm_min()) : 0.0;
}

Pointd PosedSolid::toWorld(const shape::Vec& p) const {
  return detail::transform<double>(X_WS_, p * unit_);
}

Pointd PosedSolid::directionToWorld(const shape::Vec& n) const {
  return detail::rotate<double>(X_WS_.linear(), n).normalized();
}

// Twice the worst of docs/shapes.md; that of convex shapes without faces is another.
double PosedSolid::kernelError(const Mesh& mesh) const {
  const double extent = 2 * (mesh.center().lpNorm<1>() + mesh.radius()) * per_unit_ + offsets_;
  const bool known = solid_.kind != shape::Kind::kConvex || solid_.num_faces > 0;
  return (known ? 0x1p-42 : 0x1p-29) * extent;
}

}  // namespace kios
