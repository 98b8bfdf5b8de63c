// SPDX-FileCopyrightText: 2026 The fcl_kios authors
// SPDX-License-Identifier: BSD-3-Clause
#include "query/float_solid.h"

#include <Eigen/LU>
#include <cmath>

#include "tree/prepare.h"
#include "volume/error_bounds.h"
#include "volume/rounding.h"

namespace kios {
namespace {

using engine::FloatSolid;
using Form = FloatSolid::Form;
using shape::Kind;
using shape::Range;
using shape::Vec;

/// The form that bounds a solid.
Form formOf(Kind kind) {
  switch (kind) {
    case Kind::kEllipsoid:
      return Form::kEllipsoid;
    case Kind::kCylinder:
      return Form::kCylinder;
    case Kind::kCone:
      return Form::kCone;
    case Kind::kConvex:
      return Form::kContained;
    default:
      return Form::kBox;
  }
}

/// What of the box is nearest to anything in a ball: each coordinate of the nearest point depends
/// on that of the other alone. A floor is then as large as the mesh on it, and so are the pads.
void crop(const Vec& center, double radius, Range& range) {
  const Vec low = center.array() - radius, high = center.array() + radius;
  const Vec from = range.low, to = range.high;
  range.low = low.cwiseMax(from).cwiseMin(to);
  range.high = high.cwiseMin(to).cwiseMax(from);
}

void setRows(const Eigen::Matrix3d& R, const Vec& center, const Vec& half, engine::Box& box) {
  for (int i = 0; i < 3; ++i) {
    box.x[i] = roundedTo<float>(R(i, 0));
    box.y[i] = roundedTo<float>(R(i, 1));
    box.z[i] = roundedTo<float>(R(i, 2));
    box.half[i] = roundUpFloat(half[i]);
  }
  box.half[3] = 0;
  box.x[engine::kCenter] = roundedTo<float>(center.x());
  box.y[engine::kCenter] = roundedTo<float>(center.y());
  box.z[engine::kCenter] = roundedTo<float>(center.z());
}

void setCone(const shape::Solid& s, FloatSolid& out) {
  const double slant = std::hypot(2 * s.half_length, s.radius);
  out.slant_radial = slant > 0 ? roundedTo<float>(2 * s.half_length / slant) : 1.0F;
  out.slant_axial = slant > 0 ? roundedTo<float>(s.radius / slant) : 0.0F;
  out.slant_length = roundedTo<float>(slant);
}

}  // namespace

bool makeFloatSolid(const engine::Tree& tree, const PosedSolid& posed, bool any_slab,
                    FloatSolid& out) {
  const double reach = tree.reach;
  if (!posed.hasUnit1() || tree.exponent != 0) return false;
  const shape::Solid& solid = posed.solid();
  const double solid_reach = posed.reach();
  const Eigen::Map<const Eigen::Vector3d> origin(tree.origin);
  // In double: the mesh's points as posed, as PosedSolid bounds them.
  const double points = error_bounds::solidError(2 * (origin.lpNorm<1>() + 2 * reach) +
                                                 posed.T().lpNorm<1>() + solid_reach);
  double scale = reach;
  out.margin = roundUpFloat(solid.margin());
  out.tells_inside = solid.kind != Kind::kConvex;
  out.radius = 0;
  if (solid.bounded()) {
    const Eigen::Matrix3d inverse = posed.R().inverse();
    Range range = posed.range();
    out.form = formOf(solid.kind);
    if (out.form == Form::kBox || out.form == Form::kContained) {
      const double radius = reach * (1 + posed.stretch()) * (1 + 0x1p-20) + points;
      crop(posed.R() * origin + posed.T(), radius, range);
    } else {
      out.radius = roundUpFloat(solid.radius);
      scale += solid_reach;
    }
    if (out.form == Form::kCone) setCone(solid, out);
    if (out.form == Form::kEllipsoid) {
      out.tells_inside = solid.half.minCoeff() > 0x1p-20 * solid.half.maxCoeff();
    }
    const Vec middle = 0.5 * (range.low + range.high), half = 0.5 * (range.high - range.low);
    const Vec center = inverse * (middle - posed.T()) - origin;
    setRows(posed.R(), center, half, out.box);
    scale += solid.margin() + half.norm() + center.lpNorm<1>();
    if (any_slab) scale += solid_reach;
  } else {
    out.form = solid.kind == Kind::kPlane ? Form::kPlane : Form::kHalfspace;
    const Vec n = posed.R().transpose() * solid.normal;
    const double offset = solid.offset - solid.normal.dot(posed.T()) - n.dot(origin);
    for (int c = 0; c < 3; ++c) out.normal[c] = roundedTo<float>(n[c]);
    out.offset = roundedTo<float>(offset);
    out.box = {};
    scale += std::abs(offset);
  }
  if (!(scale <= engine::kLargestReach)) return false;
  const double more = 2 * posed.stretch() * scale + points;
  const double pad = 2 * error_bounds::laneError(scale) + more;
  out.pad = roundUpFloat(pad);
  out.box_pad = roundUpFloat(error_bounds::boxError(scale) + more);
  return true;
}

// n y <= offset is n' x <= offset - n T - n' origin for y = R x + T and n' = R^T n.
engine::FloatSlab slabInTree(const engine::Tree& tree, const PosedSolid& posed, const Vec& n,
                             double offset) {
  engine::FloatSlab slab;
  const Eigen::Map<const Eigen::Vector3d> origin(tree.origin);
  const Vec across = posed.R().transpose() * n;
  for (int c = 0; c < 3; ++c) slab.n[c] = roundedTo<float>(across[c]);
  slab.offset = roundedTo<float>(offset - n.dot(posed.T()) - across.dot(origin));
  return slab;
}

}  // namespace kios
