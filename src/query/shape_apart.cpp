// SPDX-FileCopyrightText: 2026 The fcl_kios authors
// SPDX-License-Identifier: BSD-3-Clause
#include "query/posed_solid.h"

#include <fcl/geometry/shape/convex.h>
#include "model/prepared.h"
#include "search/root_body.h"
#include "shape/shape_solid.h"
#include "volume/error_bounds.h"
#include "volume/instantiate.h"

namespace kios {
namespace {

using engine::RootBody;
using shape::Vec;

/// Makes a root that proves nothing.
RootBody farRoot() {
  RootBody body;
  body.radius = kInfinity;
  return body;
}

/// Root of a shape, about its frame's origin; of a convex one without a copy of its points.
template <typename S>
RootBody rootOf(const fcl::CollisionGeometry<S>& geometry) {
  RootBody body;
  shape::Range range;
  if (geometry.getNodeType() == fcl::GEOM_CONVEX) {
    range = {Vec::Constant(kInfinity), Vec::Constant(-kInfinity)};
    double square = 0;
    for (const auto& vertex : static_cast<const fcl::Convex<S>&>(geometry).getVertices()) {
      const Vec& x = vertex.template cast<double>();
      if (!(x.lpNorm<1>() < engine::kFarthest)) return farRoot();  // squares may overflow
      range.low = range.low.cwiseMin(x);
      range.high = range.high.cwiseMax(x);
      square = std::max(square, x.squaredNorm());
    }
    if (range.low.x() > range.high.x()) return farRoot();
    body.radius = std::sqrt(square) * (1 + 0x1p-50);
  } else {
    const shape::Solid solid = toSolid(geometry);
    body.round = solid.margin();
    body.radius = solid.reach();
    if (!solid.bounded()) {
      using Form = RootBody::Form;
      body.form = solid.kind == shape::Kind::kPlane ? Form::kPlane : Form::kHalfspace;
      for (int c = 0; c < 3; ++c) {
        body.rows[c][0] = lanes::Double2{solid.normal[c], 0};
        body.rows[c][1] = lanes::Double2{0, solid.offset * solid.normal[c]};
      }
      return body;
    }
    range = shape::rangeOf(solid);
  }
  const Vec middle = 0.5 * (range.low + range.high), half = 0.5 * (range.high - range.low);
  body.rows[0][1] = lanes::Double2{0, middle[0]};
  body.rows[1][1] = lanes::Double2{0, middle[1]};
  body.rows[2][1] = lanes::Double2{1, middle[2]};
  body.half[0] = lanes::Double2{half[0], half[1]};
  body.half[1] = lanes::Double2{half[2], 0};
  return body;
}

}  // namespace

// The narrow phase poses the mesh in the shape's frame, in double.
template <typename S>
[[gnu::hot]] bool provenApart(const Model<S>& model, const fcl::Transform3<S>& X_WM,
                              const fcl::CollisionGeometry<S>& geometry,
                              const fcl::Transform3<S>& X_WS, double squared_errors,
                              double margin) {
  const RootBody shape = rootOf(geometry);
  const kIOS<S>& root = model.getBV(0).bv;
  if (shape.form == RootBody::Form::kBox &&
      engine::ballsApart(shape.center, X_WS, root.center0, X_WM,
                         shape.radius + double{root.radius0}, squared_errors, margin)) {
    return true;
  }
  const engine::Tree& tree = treeOf(model);
  if (tree.exponent != 0) return false;
  const Eigen::Map<const Vec> origin(tree.origin);
  const Eigen::Matrix3d R_SW = X_WS.linear().transpose().template cast<double>();
  const Vec T = R_SW * (X_WM.translation().template cast<double>() -
                        X_WS.translation().template cast<double>());
  engine::TreePose X_SM;
  X_SM.R = R_SW * X_WM.linear().template cast<double>();
  X_SM.t = X_SM.R * origin + T;
  X_SM.stretch = error_bounds::stretchOf<S>(squared_errors);
  const double lengths =
      2 * (origin.lpNorm<1>() + 2 * double{tree.reach}) + T.lpNorm<1>() + shape.radius + margin;
  if (!(lengths > engine::kNearest && lengths < engine::kFarthest)) return false;
  X_SM.scale = lengths;
  X_SM.frame_error = 2 * X_SM.stretch * lengths + error_bounds::solidError(lengths);
  return engine::rootBound(shape, engine::rootOf(meshOf(model)), X_SM, margin) > margin;
}

KIOS_INSTANTIATE_FUNCTION(provenApart);

}  // namespace kios
