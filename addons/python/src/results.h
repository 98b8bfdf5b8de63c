// SPDX-FileCopyrightText: 2026 The fcl_kios authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <string>
#include <type_traits>

#include <fcl/narrowphase/collision_request.h>
#include <fcl/narrowphase/collision_result.h>
#include <fcl/narrowphase/distance_request.h>
#include <fcl/narrowphase/distance_result.h>
#include <pybind11/pybind11.h>

#include "objects.h"

// python-fcl's requests and results, which are Python objects with attributes, to and from FCL's.

namespace kios::python {

/// Python's one string of a literal's content, looked up by its address.
py::handle interned(const char* literal);

/// An attribute of a Python object. Throws TypeError that names it if it is of another type.
template <typename T>
T attribute(py::handle of, const char* name) {
  const py::object value = of.attr(interned(name));
  if constexpr (std::is_same_v<T, bool>) {
    const int truth = PyObject_IsTrue(value.ptr());
    if (truth < 0) throw py::error_already_set();
    return truth != 0;
  } else {
    try {
      return value.cast<T>();
    } catch (const py::cast_error&) {
      throw py::type_error(std::string(py::str(py::type::handle_of(of).attr("__name__"))) + "." +
                           name + " can't be " + std::string(py::repr(value)) + ".");
    }
  }
}

/// The requests that a Python object asks for; None asks for the defaults. Throw TypeError that
/// names an attribute of another type.
fcl::CollisionRequestd collisionRequest(py::handle request);
fcl::DistanceRequestd distanceRequest(py::handle request);

/// A distance result without a pair: the points are NaN, which FCL leaves as memory had them.
fcl::DistanceResultd emptyResult(double min_distance);

/// Adds contacts and cost sources to a Python result. Every contact is one of a and b.
void append(fcl::CollisionResultd& found, Object& a, Object& b, py::handle result);
/// Sets a Python result to a pair that is nearer than what it holds.
void assign(const fcl::DistanceResultd& found, Object& a, Object& b, py::handle result);

/// python-fcl's rule of when a manager has found enough: one contact more than was asked for.
bool enough(const fcl::CollisionRequestd& request, std::size_t contacts);

/// result.min_distance
double minDistance(py::handle result);

/// A class or function of the module fcl_kios.fcl.
py::object ofFcl(const char* name);

}  // namespace kios::python
