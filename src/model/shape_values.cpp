// SPDX-FileCopyrightText: 2026 The fcl_kios authors
// SPDX-License-Identifier: BSD-3-Clause
#include "model/shape_values.h"

#include <cmath>
#include <cstddef>
#include <typeinfo>

#include <fcl/geometry/shape/box.h>
#include <fcl/geometry/shape/capsule.h>
#include <fcl/geometry/shape/cone.h>
#include <fcl/geometry/shape/convex.h>
#include <fcl/geometry/shape/cylinder.h>
#include <fcl/geometry/shape/ellipsoid.h>
#include <fcl/geometry/shape/halfspace.h>
#include <fcl/geometry/shape/plane.h>
#include <fcl/geometry/shape/sphere.h>
#include <fcl/geometry/shape/triangle_p.h>

namespace kios {
namespace {

/// Compares values one by one with those that are known, and puts them in their place.
template <typename S>
class Comparison {
 public:
  explicit Comparison(std::vector<S>& values) : values_(values) {}

  void take(S value) {
    if (next_ < values_.size() && (values_[next_] == value || bothNaN(values_[next_], value))) {
      ++next_;
      return;
    }
    same_ = false;
    if (next_ < values_.size()) {
      values_[next_] = value;
    } else {
      values_.push_back(value);
    }
    ++next_;
  }
  void take(const fcl::Vector3<S>& v) {
    for (int i = 0; i < 3; ++i) take(v[i]);
  }
  bool finish() {
    same_ &= next_ == values_.size() && next_ > 0;
    values_.resize(next_);
    return same_;
  }

 private:
  static bool bothNaN(S a, S b) { return std::isnan(a) && std::isnan(b); }

  std::vector<S>& values_;
  std::size_t next_ = 0;
  bool same_ = true;
};

/// The geometry, if it is of just that class: one that is derived from it may depend on more.
template <typename Shape, typename S>
const Shape* exactly(const fcl::CollisionGeometry<S>& geometry) {
  return typeid(geometry) == typeid(Shape) ? static_cast<const Shape*>(&geometry) : nullptr;
}

template <typename S>
void takeValues(const fcl::CollisionGeometry<S>& geometry, Comparison<S>& values) {
  switch (geometry.getNodeType()) {
    case fcl::GEOM_BOX:
      if (const auto* s = exactly<fcl::Box<S>>(geometry)) values.take(s->side);
      break;
    case fcl::GEOM_SPHERE:
      if (const auto* s = exactly<fcl::Sphere<S>>(geometry)) values.take(s->radius);
      break;
    case fcl::GEOM_ELLIPSOID:
      if (const auto* s = exactly<fcl::Ellipsoid<S>>(geometry)) values.take(s->radii);
      break;
    case fcl::GEOM_CAPSULE:
      if (const auto* s = exactly<fcl::Capsule<S>>(geometry)) {
        values.take(s->radius);
        values.take(s->lz);
      }
      break;
    case fcl::GEOM_CONE:
      if (const auto* s = exactly<fcl::Cone<S>>(geometry)) {
        values.take(s->radius);
        values.take(s->lz);
      }
      break;
    case fcl::GEOM_CYLINDER:
      if (const auto* s = exactly<fcl::Cylinder<S>>(geometry)) {
        values.take(s->radius);
        values.take(s->lz);
      }
      break;
    case fcl::GEOM_CONVEX:
      if (const auto* s = exactly<fcl::Convex<S>>(geometry)) {
        values.take(static_cast<S>(s->getFaceCount()));
        for (const fcl::Vector3<S>& v : s->getVertices()) values.take(v);
        for (const int i : s->getFaces()) values.take(static_cast<S>(i));
        values.take(s->getInteriorPoint());
      }
      break;
    case fcl::GEOM_PLANE:
      if (const auto* s = exactly<fcl::Plane<S>>(geometry)) {
        values.take(s->n);
        values.take(s->d);
      }
      break;
    case fcl::GEOM_HALFSPACE:
      if (const auto* s = exactly<fcl::Halfspace<S>>(geometry)) {
        values.take(s->n);
        values.take(s->d);
      }
      break;
    case fcl::GEOM_TRIANGLE:
      if (const auto* s = exactly<fcl::TriangleP<S>>(geometry)) {
        values.take(s->a);
        values.take(s->b);
        values.take(s->c);
      }
      break;
    default:
      break;
  }
}

}  // namespace

template <typename S>
bool updateShapeValues(const fcl::CollisionGeometry<S>& geometry, std::vector<S>& values) {
  Comparison<S> comparison(values);
  takeValues(geometry, comparison);
  return comparison.finish();
}

template bool updateShapeValues(const fcl::CollisionGeometry<double>&, std::vector<double>&);
template bool updateShapeValues(const fcl::CollisionGeometry<float>&, std::vector<float>&);

}  // namespace kios
