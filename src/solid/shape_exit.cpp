// SPDX-FileCopyrightText: 2026 The fcl_kios authors
// SPDX-License-Identifier: BSD-3-Clause
#include "solid/shape_exit.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <vector>

#include "fcl_kios/solid/solids.h"
#include "fcl_kios/volume/rigid.h"
#include "query/ray_walk.h"
#include "shape/shape_solid.h"
#include "shape/solid.h"
#include "solid/nearest_surface.h"
#include "solid/support_point.h"
#include "volume/instantiate.h"
#include "volume/rounding.h"

namespace kios {
namespace {

using Vec = fcl::Vector3d;

/// A point of a bounded shape: all but the convex one are centred at their origin.
Vec pointOf(const shape::Solid& solid) {
  return solid.kind == shape::Kind::kConvex ? solid.points[0] : Vec(Vec::Zero());
}

template <typename S>
class ShapeExit {
 public:
  explicit ShapeExit(const MeshAndOther<S>& pair)
      : pair_(pair),
        shape_(toSolid(pair.other)),
        X_WM_(pair.X_WM.template cast<double>()),
        X_WS_(pair.X_WO.template cast<double>()) {}

  Penetration run() {
    Vec best = Vec::Zero();
    double length = kInfinity;
    const std::vector<Vec> directions = this->directions();
    for (const Vec& n : directions) {
      const double exit = exitAlong(n);
      if (!(exit < length)) continue;
      length = exit;
      best = n;
    }
    const Vec between = X_WM_.translation() - X_WS_.translation();
    double margin = std::numeric_limits<S>::epsilon() *
                    (16 * (largestOf(pair_.mesh) + (shape_.bounded() ? shape_.reach() : 0)) +
                     16 * between.lpNorm<1>() + 4 * X_WS_.translation().template lpNorm<1>());
    constexpr int kTries = 60;
    for (int i = 0; i < kTries && !accept((std::max(length, 0.0) + margin) * best); ++i) {
      margin *= 4;
    }
    if (!(exit_.upper > 0)) return exit_;
    for (const Vec& n : directions) {
      for (double share = 0.7; accept(share * exit_.upper * n); share = 0.5) {
      }
    }
    // Its own direction, to a percent.
    const Vec end = exit_.translation;
    double low = 0.3, high = 1;
    constexpr int kHalvings = 6;
    for (int i = 0; i < kHalvings; ++i) {
      const double middle = 0.5 * (low + high);
      (accept(middle * end) ? high : low) = middle;
    }
    return exit_;
  }

 private:
  /// Returns the way by which the shape leaves the model's hull along n, in the world. A half-space
  /// or plane ends along its own normal alone, to the bit: it takes the place of what differs by
  /// rounding.
  double exitAlong(const Vec& n) const {
    Vec in_shape = X_WS_.linear().transpose() * -n;
    if (!shape_.bounded())
      in_shape = in_shape.dot(shape_.normal) > 0 ? shape_.normal : Vec(-shape_.normal);
    return supportPoint<S>(pair_.mesh, X_WM_.linear().transpose() * n).height +
           shape::extentAlong(shape_, in_shape) - n.dot(X_WS_.translation() - X_WM_.translation());
  }

  std::vector<Vec> directions() const {
    const fcl::Matrix3d &R_WM = X_WM_.linear(), &R_WS = X_WS_.linear();
    if (!shape_.bounded()) {
      const Vec n = (R_WS * shape_.normal).normalized();
      if (shape_.kind == shape::Kind::kHalfspace) return {-n};
      return {n, -n};
    }
    std::vector<Vec> directions;
    const auto add = [&](const Vec& v) {
      if (v.norm() > 0) directions.push_back(v.normalized());
    };
    const Vec center = R_WM.transpose() * (X_WS_ * pointOf(shape_) - X_WM_.translation());
    const Vec wall = R_WM * (nearestSurface(pair_.mesh, center, 0.05).point - center);
    add(wall);
    add(-wall);
    add(R_WM * (center - pair_.mesh.getBV(0).bv.center0.template cast<double>()));
    for (int c = 0; c < 3; ++c) {
      for (const double sign : {1.0, -1.0}) {
        add(sign * R_WM.col(c));
        add(sign * R_WS.col(c));
      }
    }
    return directions;
  }

  /// Keeps the translation if it is proven to part them and shorter.
  bool accept(const Vec& x) {
    fcl::Transform3<S> X_WS = pair_.X_WO;
    const fcl::Vector3<S> rounded = roundedTo<S>(x);
    X_WS.translation() += rounded;
    const double length = rounded.template cast<double>().norm();
    if (exit_.upper > 0 && !(length < exit_.upper)) return false;
    const MeshAndOther<S> moved = {pair_.mesh, pair_.X_WM, pair_.other, X_WS, nullptr};
    fcl::DistanceResult<S> found;
    if (!(moved.distanceSurfaces(fcl::DistanceRequest<S>(true), found) > 0) ||
        shapePointIn(moved)) {
      return false;
    }
    exit_ = {0, length, rounded.template cast<double>(),
             found.nearest_points[0].template cast<double>()};
    return true;
  }

  const MeshAndOther<S>& pair_;
  const shape::Solid shape_;
  const fcl::Transform3d X_WM_, X_WS_;
  Penetration exit_;
};

}  // namespace

template <typename S>
std::optional<fcl::Vector3<S>> shapePointIn(const MeshAndOther<S>& pair) {
  const shape::Solid shape = toSolid(pair.other);
  if (!shape.bounded()) return std::nullopt;
  const fcl::Vector3<S> p = detail::transform<S>(pair.X_WO, roundedTo<S>(pointOf(shape)));
  if (!contains<S>(pair.mesh, pair.X_WM, p)) return std::nullopt;
  return p;
}

template <typename S>
Penetration shapeExit(const MeshAndOther<S>& pair) {
  return ShapeExit<S>(pair).run();
}

KIOS_INSTANTIATE_FUNCTION(shapePointIn);
KIOS_INSTANTIATE_FUNCTION(shapeExit);

}  // namespace kios
