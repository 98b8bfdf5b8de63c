// SPDX-FileCopyrightText: 2026 The fcl_kios authors
// SPDX-License-Identifier: BSD-3-Clause
//
// python-fcl's transforms and objects.
#include "objects.h"

#include <memory>
#include <stdexcept>
#include <string>
#include <utility>

#include "arrays.h"

namespace kios::python {
namespace {

using Geometry = fcl::CollisionGeometryd;

struct Transform {
  fcl::Transform3d X = fcl::Transform3d::Identity();
};

void setRotation(fcl::Transform3d& X, py::handle value) {
  const py::array array = py::array::ensure(value);
  if (array && array.ndim() == 2 && array.shape(0) == 3 && array.shape(1) == 3) {
    X.linear() = matrix(value, "rotation");
  } else if (array && array.ndim() == 1 && array.shape(0) == 4) {
    X.linear() = rotation(value, "quaternion");
  } else {
    PyErr_Clear();
    throw std::invalid_argument("Transform: a (3, 3) rotation or a quaternion (4,) is needed.");
  }
}

Transform makeTransform(const py::args& args) {
  Transform made;
  if (args.size() > 2) throw std::invalid_argument("Transform: at most two arguments are taken.");
  if (args.size() == 1 && py::isinstance<Transform>(args[0])) return args[0].cast<Transform>();
  if (args.size() == 1) {
    const py::array array = py::array::ensure(args[0]);
    if (array && array.ndim() == 1 && array.shape(0) == 3) {
      made.X.translation() = vector(args[0], "translation");
      return made;
    }
    PyErr_Clear();
  }
  if (args.size() > 0) setRotation(made.X, args[0]);
  if (args.size() == 2) made.X.translation() = vector(args[1], "translation");
  return made;
}

void bindTransform(py::module_& m) {
  py::class_<Transform>(
      m, "Transform",
      "Transform(*args)\n--\n\nA pose: Transform(), (rotation), (translation), "
      "(rotation, translation) or (Transform).\nA rotation is (3, 3), or a "
      "quaternion w, x, y, z. What was rounded to few decimals is made orthonormal.")
      .def(py::init(&makeTransform), "__init__(self, *args)\n--\n\nSee the class.")
      .def(
          "getRotation", [](const Transform& t) { return toMatrix(t.X.linear()); },
          "getRotation(self)\n--\n\n(3, 3)")
      .def(
          "getTranslation", [](const Transform& t) { return toArray(t.X.translation()); },
          "getTranslation(self)\n--\n\n(3,)")
      .def(
          "getQuatRotation", [](const Transform& t) { return toQuaternion(t.X.linear()); },
          "getQuatRotation(self)\n--\n\nw, x, y, z")
      .def(
          "setRotation", [](Transform& t, py::handle R) { t.X.linear() = matrix(R, "rotation"); },
          py::arg("R"), "setRotation(self, R)\n--\n\nR: (3, 3)")
      .def(
          "setTranslation",
          [](Transform& t, py::handle T) { t.X.translation() = vector(T, "translation"); },
          py::arg("T"), "setTranslation(self, T)\n--\n\nT: (3,)")
      .def(
          "setQuatRotation",
          [](Transform& t, py::handle q) { t.X.linear() = rotation(q, "quaternion"); },
          py::arg("q"), "setQuatRotation(self, q)\n--\n\nq: w, x, y, z");
}

/// Waits for the queries that read it, by itself or in a manager.
template <typename Set>
void moveObject(Object& object, const Set& set) {
  awaitTurn(
      [&] {
        for (const std::shared_ptr<Turns>& manager : object.managers) {
          if (manager->readers > 0) return manager;
        }
        return ifRead(object.turns);
      },
      "object");
  set(object.object);
  object.object.computeAABB();
}

struct VisitGeometry {
  template <typename Each>
  void operator()(Object& object, const Each& each) const {
    each(object.geometry);
  }
  static void clear(Object& object) { object.geometry = py::none(); }
};

void bindObject(py::module_& m) {
  py::class_<Object>(
      m, "CollisionObject",
      "CollisionObject(geom=None, tf=None)\n--\n\nA geometry at its pose in the world.",
      py::custom_type_setup(
          [](PyHeapTypeObject* type) { traverse<Object>(type, VisitGeometry()); }))
      .def(py::init([](py::object geom, const Transform* tf) {
             if (!geom.is_none() && !py::isinstance<Geometry>(geom)) {
               throw py::type_error("CollisionObject: geom must be a CollisionGeometry.");
             }
             if (geom.is_none() || geom.attr("getNodeType")().is_none()) {
               throw std::invalid_argument("CollisionObject: a geometry is needed.");
             }
             return std::make_unique<Object>(std::move(geom),
                                             tf ? tf->X : fcl::Transform3d::Identity());
           }),
           py::arg("geom") = py::none(), py::arg("tf") = py::none(),
           "__init__(self, geom=None, tf=None)\n--\n\ntf: a Transform; None: the identity.")
      .def(
          "getObjectType",
          [](const Object& o) { return static_cast<int>(o.object.getObjectType()); },
          "getObjectType(self)\n--\n\nOne of OBJECT_TYPE.")
      .def(
          "getNodeType", [](const Object& o) { return o.geometry.attr("getNodeType")(); },
          "getNodeType(self)\n--\n\nOne of NODE_TYPE.")
      .def(
          "getTranslation", [](const Object& o) { return toArray(o.object.getTranslation()); },
          "getTranslation(self)\n--\n\n(3,)")
      .def(
          "getRotation", [](const Object& o) { return toMatrix(o.object.getRotation()); },
          "getRotation(self)\n--\n\n(3, 3)")
      .def(
          "getQuatRotation", [](const Object& o) { return toQuaternion(o.object.getRotation()); },
          "getQuatRotation(self)\n--\n\nw, x, y, z")
      .def(
          "getTransform", [](const Object& o) { return Transform{o.object.getTransform()}; },
          "getTransform(self)\n--\n\nA copy of its Transform.")
      .def(
          "setTranslation",
          [](Object& o, py::handle vec) {
            const Eigen::Vector3d p = vector(vec, "translation");
            moveObject(o, [&](auto& object) { object.setTranslation(p); });
          },
          py::arg("vec"), "setTranslation(self, vec)\n--\n\nvec: (3,)")
      .def(
          "setRotation",
          [](Object& o, py::handle mat) {
            const Eigen::Matrix3d R = matrix(mat, "rotation");
            moveObject(o, [&](auto& object) { object.setRotation(R); });
          },
          py::arg("mat"), "setRotation(self, mat)\n--\n\nmat: (3, 3)")
      .def(
          "setQuatRotation",
          [](Object& o, py::handle q) {
            const Eigen::Matrix3d R = rotation(q, "quaternion");
            moveObject(o, [&](auto& object) { object.setRotation(R); });
          },
          py::arg("q"), "setQuatRotation(self, q)\n--\n\nq: w, x, y, z")
      .def(
          "setTransform",
          [](Object& o, const Transform& tf) {
            moveObject(o, [&](auto& object) { object.setTransform(tf.X); });
          },
          py::arg("tf"), "setTransform(self, tf)\n--\n\ntf: a Transform")
      .def(
          "isOccupied", [](const Object& o) { return o.object.collisionGeometry()->isOccupied(); },
          "isOccupied(self)\n--\n\nWhether the geometry is known to be there.")
      .def(
          "isFree", [](const Object& o) { return o.object.collisionGeometry()->isFree(); },
          "isFree(self)\n--\n\nWhether it is known not to be.")
      .def(
          "isUncertain",
          [](const Object& o) { return o.object.collisionGeometry()->isUncertain(); },
          "isUncertain(self)\n--\n\nWhether neither is.")
      .def_property_readonly("_geometry", [](const Object& o) { return o.geometry; });
}

}  // namespace

Object::Object(py::object of, const fcl::Transform3d& X)
    : object(of.cast<std::shared_ptr<Geometry>>(), X), geometry(std::move(of)) {
  ++geometryTurns().placed;
  object.setUserData(this);
  computeLocalBox(geometry.cast<Geometry&>());
  object.computeAABB();
}

void computeLocalBox(Geometry& geometry) {
  constexpr double kFar = 1e100;  // its square and its sums are finite
  geometry.computeLocalAABB();
  fcl::AABBd& box = geometry.aabb_local;
  if ((box.min_.array() > box.max_.array()).any()) box = fcl::AABBd(Eigen::Vector3d::Zero());
  if (box.min_.minCoeff() >= -kFar && box.max_.maxCoeff() <= kFar) return;
  box.min_ = box.min_.cwiseMax(-kFar);
  box.max_ = box.max_.cwiseMin(kFar);
  geometry.aabb_center = box.center();
  geometry.aabb_radius = (box.max_ - box.min_).norm() / 2;
}

void requireServed(Query query, const fcl::CollisionObjectd& a, const fcl::CollisionObjectd& b) {
  const fcl::NODE_TYPE types[2] = {a.getNodeType(), b.getNodeType()};
  const auto either = [&](fcl::NODE_TYPE type) { return types[0] == type || types[1] == type; };
  const bool plane = either(fcl::GEOM_PLANE);
  if ((!plane && !either(fcl::GEOM_HALFSPACE)) || either(fcl::BV_UNKNOWN)) return;
  if (query != Query::kDistance && plane && either(fcl::GEOM_CONVEX)) {
    throw std::invalid_argument(
        "fcl_kios: FCL crashes on collisions of a Convex and a Plane; make the Convex a BVHModel.");
  }
  if (query != Query::kCollide) {
    throw std::invalid_argument(
        "fcl_kios: FCL has no distance of a Plane or Halfspace and a shape; make the shape a "
        "BVHModel.");
  }
}

fcl::Transform3d transformOf(py::handle value) { return value.cast<const Transform&>().X; }

void bindObjects(py::module_& m) {
  bindTransform(m);
  bindObject(m);
}

}  // namespace kios::python
