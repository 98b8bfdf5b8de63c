// SPDX-FileCopyrightText: 2026 The fcl_kios authors
// SPDX-License-Identifier: BSD-3-Clause
#include "results.h"

#include <limits>
#include <unordered_map>
#include <vector>

#include "arrays.h"

namespace kios::python {
namespace {

/// The caller's geometry that FCL names: FCL may swap the two.
py::object geometryOf(const fcl::CollisionGeometryd* geometry, Object& a, Object& b) {
  return geometry == a.object.collisionGeometry().get() ? a.geometry : b.geometry;
}

/// An instance whose __init__ isn't called, as all its attributes are set.
py::object bare(py::handle type) {
  auto* const of = reinterpret_cast<PyTypeObject*>(type.ptr());
  const py::tuple nothing;
  py::object made = py::reinterpret_steal<py::object>(of->tp_new(of, nothing.ptr(), nullptr));
  if (!made) throw py::error_already_set();
  return made;
}

}  // namespace

// Both keep what they found for as long as the process runs.
py::handle interned(const char* literal) {
  static std::unordered_map<const char*, PyObject*> names;
  PyObject*& name = names[literal];
  if (!name) name = PyUnicode_InternFromString(literal);
  return name;
}
py::object ofFcl(const char* name) {
  static std::unordered_map<const char*, PyObject*> found;
  const auto at = found.find(name);
  if (at != found.end()) return py::reinterpret_borrow<py::object>(at->second);
  const py::object made = py::module_::import("fcl_kios.fcl").attr(name);
  found[name] = py::object(made).release().ptr();
  return made;
}

fcl::CollisionRequestd collisionRequest(py::handle request) {
  if (request.is_none()) return {};
  const int solver = attribute<int>(request, "gjk_solver_type");
  return {attribute<std::size_t>(request, "num_max_contacts"),
          attribute<bool>(request, "enable_contact"),
          attribute<std::size_t>(request, "num_max_cost_sources"),
          attribute<bool>(request, "enable_cost"),
          attribute<bool>(request, "use_approximate_cost"),
          solver == fcl::GST_INDEP ? fcl::GST_INDEP : fcl::GST_LIBCCD};
}

fcl::DistanceRequestd distanceRequest(py::handle request) {
  if (request.is_none()) return fcl::DistanceRequestd();
  // python-fcl hands the solver on as rel_err: no program has ever got the one it named.
  return fcl::DistanceRequestd(attribute<bool>(request, "enable_nearest_points"),
                               attribute<bool>(request, "enable_signed_distance"));
}

fcl::DistanceResultd emptyResult(double min_distance) {
  fcl::DistanceResultd result(min_distance);
  for (Eigen::Vector3d& point : result.nearest_points) {
    point.setConstant(std::numeric_limits<double>::quiet_NaN());
  }
  return result;
}

double minDistance(py::handle result) { return attribute<double>(result, "min_distance"); }

void append(fcl::CollisionResultd& found, Object& a, Object& b, py::handle result) {
  if (!found.isCollision() && found.numCostSources() == 0) return;
  const auto set = [](py::handle of, const char* name, const auto& value) {
    of.attr(interned(name)) = value;
  };
  if (found.isCollision()) {
    set(result, "is_collision", true);
    const py::object contact_class = ofFcl("Contact");
    const py::object add = result.attr(interned("contacts")).attr(interned("append"));
    for (std::size_t i = 0; i < found.numContacts(); ++i) {
      if (i % 1024 == 1023) listen();
      const fcl::Contactd& contact = found.getContact(i);
      const py::object made = bare(contact_class);
      set(made, "o1", geometryOf(contact.o1, a, b));
      set(made, "o2", contact.o1 == contact.o2 ? b.geometry : geometryOf(contact.o2, a, b));
      set(made, "b1", contact.b1);
      set(made, "b2", contact.b2);
      set(made, "normal", toArray(contact.normal));
      set(made, "pos", toArray(contact.pos));
      set(made, "penetration_depth", contact.penetration_depth);
      add(made);
    }
  }
  std::vector<fcl::CostSourced> costs;
  found.getCostSources(costs);
  for (const fcl::CostSourced& cost : costs) {
    const py::object made = ofFcl("CostSource")();
    set(made, "aabb_min", toArray(cost.aabb_min));
    set(made, "aabb_max", toArray(cost.aabb_max));
    set(made, "cost_density", cost.cost_density);
    set(made, "total_cost", cost.total_cost);
    result.attr("cost_sources").attr("append")(made);
  }
}

void assign(const fcl::DistanceResultd& found, Object& a, Object& b, py::handle result) {
  const auto set = [&](const char* name, const auto& value) {
    result.attr(interned(name)) = value;
  };
  set("min_distance", found.min_distance);
  py::list points;
  for (const Eigen::Vector3d& point : found.nearest_points) points.append(toArray(point));
  set("nearest_points", points);
  set("o1", geometryOf(found.o1, a, b));
  set("o2", found.o1 == found.o2 ? b.geometry : geometryOf(found.o2, a, b));
  set("b1", found.b1);
  set("b2", found.b2);
}

}  // namespace kios::python
