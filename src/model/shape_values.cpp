// SPDX-FileCopyrightText: 2026 The fcl_kios authors
// SPDX-License-Identifier: BSD-3-Clause
#include "model/shape_values.h"

#include <cmath>
#include <cstddef>
#include <type_traits>
#include <typeinfo>

#include "shape/visit_shape.h"
#include "volume/instantiate.h"
#include "volume/rounding.h"

namespace kios {
namespace {

/// Calls take(v) with every value, in one order.
template <typename S, typename Take>
void takeValues(const fcl::CollisionGeometry<S>& geometry, const Take& take) {
  const auto takeAll = [&](const fcl::Vector3<S>& v) {
    for (int i = 0; i < 3; ++i) take(v[i]);
  };
  const auto takeRound = [&](const auto& round) { take(round.radius), take(round.lz); };
  const auto takePlane = [&](const auto& plane) { takeAll(plane.n), take(plane.d); };
  visitShape(
      geometry, [&](const fcl::Box<S>& box) { takeAll(box.side); },
      [&](const fcl::Sphere<S>& sphere) { take(sphere.radius); },
      [&](const fcl::Ellipsoid<S>& ellipsoid) { takeAll(ellipsoid.radii); },
      [&](const fcl::Capsule<S>& capsule) { takeRound(capsule); },
      [&](const fcl::Cone<S>& cone) { takeRound(cone); },
      [&](const fcl::Cylinder<S>& cylinder) { takeRound(cylinder); },
      [&](const fcl::Plane<S>& plane) { takePlane(plane); },
      [&](const fcl::Halfspace<S>& halfspace) { takePlane(halfspace); },
      [&](const fcl::TriangleP<S>& t) { takeAll(t.a), takeAll(t.b), takeAll(t.c); },
      [&](const fcl::Convex<S>& convex) {
        take(roundedTo<S>(convex.getFaceCount()));
        for (const fcl::Vector3<S>& v : convex.getVertices()) takeAll(v);
        for (const int i : convex.getFaces()) take(roundedTo<S>(i));
        takeAll(convex.getInteriorPoint());
      });
}

}  // namespace

template <typename S>
bool isShapeOfFcl(const fcl::CollisionGeometry<S>& geometry) {
  bool same = false;
  visitShape(geometry, [&](const auto& shape) {
    same = typeid(geometry) == typeid(std::decay_t<decltype(shape)>);
  });
  return same;
}

template <typename S>
std::vector<S> shapeValues(const fcl::CollisionGeometry<S>& geometry) {
  std::vector<S> values;
  takeValues(geometry, [&values](S value) { values.push_back(value); });
  return values;
}

template <typename S>
bool hasShapeValues(const fcl::CollisionGeometry<S>& geometry, const std::vector<S>& values) {
  std::size_t next = 0;
  bool same = true;
  takeValues(geometry, [&](S value) {
    same = same && next < values.size() &&
           (values[next] == value || (std::isnan(values[next]) && std::isnan(value)));
    ++next;
  });
  return same && next == values.size();
}

KIOS_INSTANTIATE_FUNCTION(isShapeOfFcl);
KIOS_INSTANTIATE_FUNCTION(shapeValues);
KIOS_INSTANTIATE_FUNCTION(hasShapeValues);

}  // namespace kios
