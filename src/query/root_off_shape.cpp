// SPDX-FileCopyrightText: 2026 The fcl_kios authors
// SPDX-License-Identifier: BSD-3-Clause
#include "query/root_off_shape.h"

#include <algorithm>
#include <cmath>

#include <fcl/geometry/shape/convex.h>
#include "model/prepared.h"
#include "search/double_bound.h"
#include "shape/shape_solid.h"
#include "volume/far_apart.h"
#include "volume/instantiate.h"
#include "volume/rounding.h"

namespace kios {
namespace {

using shape::Kind;
using shape::Vec;

/// A shape in its frame and a point p, of a convex one without a copy of its points.
template <typename S>
class ShapeAndPoint {
 public:
  ShapeAndPoint(const fcl::CollisionGeometry<S>& geometry, const Vec& p)
      : geometry_(geometry), solid_(solidOf(geometry)), p_(p) {
    if (solid_.kind != Kind::kConvex) {
      reach_ = solid_.reach();
      return;
    }
    if (vertices().empty()) reach_ = kInfinity;  // toSolid() refuses it
    for (const fcl::Vector3<S>& vertex : vertices()) {
      const Vec& x = vertex.template cast<double>();
      reach_ += x.lpNorm<1>();
      if (!(reach_ < CentralWay::kFar)) return;  // products might be infinite
      highest_ = std::max(highest_, p.dot(x));
    }
  }

  /// At least the largest distance of its points from its origin, or above CentralWay::kFar, as
  /// for a convex shape without any; NaN if there are such vertices.
  double reach() const { return reach_; }
  /// Lower bound of p's distance: of a convex shape by the slab across the way there, of an
  /// ellipsoid by its box if that is more than `enough`.
  double distance(double enough) const {
    if (solid_.kind == Kind::kEllipsoid) {
      const double by_box = (p_.cwiseAbs() - solid_.half).cwiseMax(0.0).norm();
      if (by_box > enough) return by_box;
    }
    if (solid_.kind != Kind::kConvex) return shape::pointBound(solid_, p_);
    constexpr double kLeastSquare = 0x1p-200;
    const double square = p_.squaredNorm();
    if (!(square > kLeastSquare)) return -kInfinity;
    return (square - highest_) / std::sqrt(square);
  }
  /// As shape::extentAlong(); +infinity for convex shapes of many points.
  double extentAlong(const Vec& n) const {
    constexpr std::size_t kMany = 64;
    if (solid_.kind != Kind::kConvex) return shape::extentAlong(solid_, n);
    if (vertices().size() > kMany) return kInfinity;
    double most = -kInfinity;
    for (const fcl::Vector3<S>& x : vertices()) {
      most = std::max(most, n.dot(x.template cast<double>()));
    }
    return most;
  }
  /// The unit normal of the face of a box, half-space or plane that faces p, and how far the shape
  /// reaches along it; false for other shapes.
  bool faceTowards(const Vec& p, Vec& n, double& extent) const {
    switch (solid_.kind) {
      case Kind::kBox: {
        int axis;
        (p.cwiseAbs() - solid_.half).maxCoeff(&axis);
        n = Vec::Unit(axis) * (p[axis] < 0 ? -1 : 1);
        extent = solid_.half[axis];
        return true;
      }
      case Kind::kHalfspace:
      case Kind::kPlane: {
        const bool below = solid_.kind == Kind::kPlane && solid_.normal.dot(p) < solid_.offset;
        n = below ? Vec(-solid_.normal) : solid_.normal;
        extent = below ? -solid_.offset : solid_.offset;
        return true;
      }
      default:
        return false;
    }
  }

 private:
  static shape::Solid solidOf(const fcl::CollisionGeometry<S>& geometry) {
    if (geometry.getNodeType() != fcl::GEOM_CONVEX) return toSolid(geometry);
    shape::Solid none;
    none.kind = Kind::kConvex;
    return none;
  }
  const std::vector<fcl::Vector3<S>>& vertices() const {
    return static_cast<const fcl::Convex<S>&>(geometry_).getVertices();
  }
  const fcl::CollisionGeometry<S>& geometry_;
  const shape::Solid solid_;
  const Vec p_;
  double reach_ = 0, highest_ = -kInfinity;
};

/// Whether the box of the model's tree is farther than `margin` from the shape along its own axis
/// that faces the shape, or along the shape's that faces it; `way` leads from the shape's origin to
/// the centre of the root's sphere, in the world.
// In the shape's frame, n of length 1 but for 2 u of the box's axis, u = 2^-24: what lies between
// along n, R_S R_S^T - I and R_M^T R_M - I times the lengths off, which 2 kSlack has room for.
template <typename S>
bool boxOffShape(const Model<S>& model, const Eigen::Matrix3d& R_WM, const ShapeAndPoint<S>& shape,
                 const Eigen::Matrix3d& R_WS, const Vec& way, double lengths, double margin) {
  engine::TreeRoot root;
  if (!copyRoot(model, root)) return false;
  const engine::Box& box = root.root_box;
  const Eigen::Map<const Vec> origin(root.origin);
  const Vec center = model.getBV(0).bv.center0.template cast<double>() - origin;
  const double slack = 2 * CentralWay::kSlack<S> * (lengths + origin.template lpNorm<1>()) +
                       engine::kStored * (2 * engine::extentOf(box) + 4 * shape.reach());
  const auto proves = [&](double gap) { return (1 - 4 * kUlpFloat) * gap > margin + slack; };

  const engine::OutOfBox out(box, center - R_WM.transpose() * way);
  if (out.height > margin) {
    const int axis = out.axis();
    const Vec n = R_WS.transpose() * (R_WM * engine::columnOf(box, axis));
    const double extent = shape.extentAlong(out.along[axis] < 0 ? n : Vec(-n));
    if (proves(out.height - extent)) return true;
  }
  const Vec p = R_WS.transpose() * (way + R_WM * (engine::columnOf(box, engine::kCenter) - center));
  Vec n;
  double extent;
  if (!shape.faceTowards(p, n, extent)) return false;
  const double height = n.dot(p) - extent;
  return height > margin && proves(height - engine::reachAlong(box, R_WM.transpose() * (R_WS * n)));
}

}  // namespace

// The way from the shape's origin, a centre that is 0, to the sphere's, turned into its frame:
// CentralWay says what that is off by, shape::pointBound() by less than 2^-48 of the lengths. Those
// below kNear may have squares that vanish.
template <typename S>
[[gnu::hot]] bool rootOffShape(const Model<S>& model, const fcl::Transform3<S>& X_WM,
                               const fcl::CollisionGeometry<S>& geometry,
                               const fcl::Transform3<S>& X_WS, double squared_errors,
                               double margin) {
  constexpr double kNear = 0x1p-90;
  const kIOS<S>& root = model.getBV(0).bv;
  const CentralWay way(CentralWay::Origin<S>(), X_WS, root, X_WM);
  if (!(way.lengths < CentralWay::kFar)) return false;
  const Vec w(way.w[0], way.w[1], way.w[2]);
  const Eigen::Matrix3d R_WS = X_WS.linear().template cast<double>();
  const ShapeAndPoint<S> shape(geometry, R_WS.transpose() * w);
  const double lengths = way.lengths + shape.reach() + margin;
  if (!(lengths > kNear && CentralWay::canProve<S>(lengths, squared_errors))) return false;
  const double least = double{root.radius0} + margin + CentralWay::kSlack<S> * lengths;
  return shape.distance(least) > least ||
         boxOffShape(model, Eigen::Matrix3d(X_WM.linear().template cast<double>()), shape, R_WS, w,
                     lengths, margin);
}

KIOS_INSTANTIATE_FUNCTION(rootOffShape);

}  // namespace kios
