// SPDX-FileCopyrightText: 2026 The fcl_kios authors
// SPDX-License-Identifier: BSD-3-Clause
#include "query/posed_solid.h"

#include "search/root_body.h"
#include "volume/error_bounds.h"
#include "volume/instantiate.h"

namespace kios {
namespace {

using engine::RootBody;
using shape::Vec;

/// Root of a shape, about its frame's origin.
RootBody rootOf(const shape::Solid& solid) {
  RootBody body;
  body.round = solid.margin();
  body.radius = solid.reach() * (1 + 0x1p-50);
  if (!solid.bounded()) {
    using Form = RootBody::Form;
    body.form = solid.kind == shape::Kind::kPlane ? Form::kPlane : Form::kHalfspace;
    for (int c = 0; c < 3; ++c) {
      body.rows[c] = {solid.normal[c], 0, 0, solid.offset * solid.normal[c]};
    }
    return body;
  }
  const shape::Range range = shape::rangeOf(solid);
  const Vec middle = 0.5 * (range.low + range.high), half = 0.5 * (range.high - range.low);
  for (int c = 0; c < 3; ++c) body.rows[c][3] = middle[c];
  body.half.head<3>() = half;
  return body;
}

}  // namespace

template <typename S>
[[gnu::hot]] bool provenApart(const Mesh& mesh, const fcl::Transform3<S>& X_WM,
                              const shape::Solid& solid, const fcl::Transform3<S>& X_WS,
                              double squared_errors, double margin) {
  const RootBody shape = rootOf(solid);
  if (shape.form == RootBody::Form::kBox &&
      engine::ballsApart(shape.center, X_WS, mesh.center(), X_WM, shape.radius + mesh.radius(),
                         squared_errors, margin)) {
    return true;
  }
  const engine::Tree& tree = mesh.tree();
  if (tree.exponent != 0) return false;
  const Eigen::Map<const Vec> origin(tree.origin);
  const RelativePosed pose(X_WS, X_WM, squared_errors);
  engine::TreePose X_SM;
  X_SM.R = pose.R();
  X_SM.t = pose * Vec(origin);
  X_SM.stretch = detail::boundsOf(pose).stretch;
  const double lengths = 2 * (origin.lpNorm<1>() + 2 * double{tree.reach}) +
                         detail::boundsOf(pose).T_norm1 + shape.radius + margin;
  if (!(lengths > engine::kNearest && lengths < engine::kFarthest)) return false;
  X_SM.scale = lengths;
  X_SM.frame_error = 2 * X_SM.stretch * lengths + error_bounds::solidError(lengths);
  return engine::rootBound(shape, engine::rootOf(mesh), X_SM, margin) > margin;
}

KIOS_INSTANTIATE_FUNCTION(provenApart);

}  // namespace kios
