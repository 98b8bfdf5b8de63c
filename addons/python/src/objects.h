// SPDX-FileCopyrightText: 2026 The fcl_kios authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <memory>
#include <vector>

#include <fcl/geometry/collision_geometry.h>
#include <fcl/narrowphase/collision_object.h>
#include <pybind11/pybind11.h>

#include "turns.h"
#include "without_gil.h"

namespace kios::python {

/// A Python CollisionObject. FCL's object points back to it by its user data.
struct Object {
  Object(py::object of, const fcl::Transform3d& X);
  Object(const Object&) = delete;
  ~Object() { --turnsOf(*object.collisionGeometry()).placed; }

  fcl::CollisionObjectd object;
  py::object geometry;  ///< the caller's own; kept alive
  Turns turns{};
  std::vector<std::shared_ptr<Turns>> managers;  ///< that have it, by their turns

  static Object& of(const fcl::CollisionObjectd& object) {
    return *static_cast<Object*>(object.getUserData());
  }
  /// The caller's own Python object.
  py::object self() { return py::cast(this, py::return_value_policy::reference); }
  Turns& geometryTurns() const { return turnsOf(*object.collisionGeometry()); }
};

/// Marks two objects and their geometries.
inline Reading readingBoth(Object& a, Object& b) {
  return Reading(&a.turns, &a.geometryTurns(), &b.turns, &b.geometryTurns());
}

/// FCL's queries, as far as what they don't survive is concerned.
enum class Query { kCollide, kDistance, kContinuous };

/// Throws std::invalid_argument for a pair of shapes that makes FCL crash.
void requireServed(Query query, const fcl::CollisionObjectd& a, const fcl::CollisionObjectd& b);

/// Computes the box of a geometry in its own frame. That of a half-space, a plane or an empty mesh
/// is no box, and makes FCL's managers crash: it becomes a finite one.
void computeLocalBox(fcl::CollisionGeometryd& geometry);

/// The pose of a Python Transform.
fcl::Transform3d transformOf(py::handle transform);

/// Lets Python's collector see through objects that hold others: `visit` calls its argument with
/// each py::object that T holds.
template <typename T, typename Visit>
void traverse(PyHeapTypeObject* heap_type, Visit /*each*/) {
  PyTypeObject& type = heap_type->ht_type;
  type.tp_flags |= Py_TPFLAGS_HAVE_GC;
  static const auto held = [](PyObject* self) -> T* {
    auto holder = reinterpret_cast<py::detail::instance*>(self)->get_value_and_holder();
    return holder.holder_constructed() ? static_cast<T*>(holder.value_ptr()) : nullptr;
  };
  type.tp_traverse = [](PyObject* self, visitproc visit, void* arg) {
    Py_VISIT(Py_TYPE(self));
    int result = 0;
    if (T* const at = held(self)) {
      Visit()(*at, [&](py::object& object) {
        if (result == 0 && object) result = visit(object.ptr(), arg);
      });
    }
    return result;
  };
  type.tp_clear = [](PyObject* self) {
    if (T* const at = held(self)) Visit::clear(*at);
    return 0;
  };
}

void bindGeometries(py::module_& m);
void bindObjects(py::module_& m);
void bindQueries(py::module_& m);
void bindManager(py::module_& m);
void bindMesh(py::module_& m);
void bindScene(py::module_& m);
void bindFiles(py::module_& m);
void bindRobot(py::module_& m);  ///< where the addon robot is built

}  // namespace kios::python
