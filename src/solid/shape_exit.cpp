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
        model_(pair.mesh),
        solid_(toSolid(pair.other)),
        R_WM_(pair.X_WM.linear().template cast<double>()),
        t_WM_(pair.X_WM.translation().template cast<double>()),
        R_WS_(pair.X_WO.linear().template cast<double>()),
        t_WS_(pair.X_WO.translation().template cast<double>()) {}

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
    const double rounding = std::numeric_limits<S>::epsilon() *
                            (16 * largestOf(model_) + 16 * (solid_.bounded() ? solid_.reach() : 0) +
                             16 * (t_WM_ - t_WS_).lpNorm<1>() + 4 * t_WS_.lpNorm<1>());
    Penetration result;
    double margin = rounding;
    constexpr int kTries = 60;
    for (int i = 0; i < kTries && !accept((std::max(length, 0.0) + margin) * best, result); ++i) {
      margin *= 4;
    }
    if (!(result.upper > 0)) return result;
    for (const Vec& n : directions) {
      for (double share = 0.7; accept(share * result.upper * n, result); share = 0.5) {
      }
    }
    // Its own direction, to a percent.
    const Vec end = result.translation;
    double low = 0.3, high = 1;
    constexpr int kHalvings = 6;
    for (int i = 0; i < kHalvings; ++i) {
      const double middle = 0.5 * (low + high);
      (accept(middle * end, result) ? high : low) = middle;
    }
    return result;
  }

 private:
  Vec inModel(const Vec& p_W) const { return R_WM_.transpose() * (p_W - t_WM_); }

  /// Turns n into the shape's frame. A half-space or plane ends along its own normal alone, to the
  /// bit, so that it takes the place of what differs by rounding.
  Vec inShape(const Vec& n) const {
    if (solid_.bounded()) return R_WS_.transpose() * n;
    return n.dot(R_WS_ * solid_.normal) > 0 ? solid_.normal : Vec(-solid_.normal);
  }

  /// Returns the way by which b leaves the model's hull along n, in the world.
  double exitAlong(const Vec& n) const {
    const double shape = shape::extentAlong(solid_, inShape(-n)) - n.dot(t_WS_ - t_WM_);
    return supportPoint<S>(model_, R_WM_.transpose() * n).height + shape;
  }

  std::vector<Vec> directions() const {
    if (!solid_.bounded()) {
      const Vec n = (R_WS_ * solid_.normal).normalized();
      if (solid_.kind == shape::Kind::kHalfspace) return {-n};
      return {n, -n};
    }
    std::vector<Vec> directions;
    const Vec center = inModel(R_WS_ * pointOf(solid_) + t_WS_);
    const auto add = [&](const Vec& v) {
      if (v.norm() > 0) directions.push_back((R_WM_ * v).normalized());
    };
    const Vec wall = nearestSurface(model_, center, 0.05).point - center;
    add(wall);
    add(-wall);
    add(center - model_.getBV(0).bv.center0.template cast<double>());
    for (int c = 0; c < 3; ++c) {
      add(Vec::Unit(c));
      add(-Vec::Unit(c));
      directions.emplace_back(R_WS_.col(c).normalized());
      directions.emplace_back(-R_WS_.col(c).normalized());
    }
    return directions;
  }

  /// Keeps the translation if it is proven to part them and shorter.
  bool accept(const Vec& x, Penetration& result) const {
    // Copies, also where S is double.
    // NOLINTBEGIN(performance-unnecessary-copy-initialization)
    const fcl::Vector3<S> rounded = x.template cast<S>();
    const Vec translation = rounded.template cast<double>();
    // NOLINTEND(performance-unnecessary-copy-initialization)
    const double length = translation.norm();
    if (result.upper > 0 && !(length < result.upper)) return false;
    fcl::Transform3<S> X_WS = pair_.X_WO;
    X_WS.translation() += rounded;
    const MeshAndOther<S> moved = {model_, pair_.X_WM, pair_.other, X_WS, nullptr};
    fcl::DistanceRequest<S> request(true);
    fcl::DistanceResult<S> found;
    if (!(moved.distanceSurfaces(request, found) > 0) || shapePointIn(moved)) return false;
    result.upper = length;
    result.translation = translation;
    result.point = found.nearest_points[0].template cast<double>();
    return true;
  }

  const MeshAndOther<S>& pair_;
  const Model<S>& model_;
  const shape::Solid solid_;
  const fcl::Matrix3d R_WM_;
  const Vec t_WM_;
  const fcl::Matrix3d R_WS_;
  const Vec t_WS_;
};

}  // namespace

template <typename S>
std::optional<fcl::Vector3<S>> shapePointIn(const MeshAndOther<S>& pair) {
  const shape::Solid shape = toSolid(pair.other);
  if (!shape.bounded()) return std::nullopt;
  const fcl::Vector3<S> p = detail::transform<S>(pair.X_WO, pointOf(shape).template cast<S>());
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
