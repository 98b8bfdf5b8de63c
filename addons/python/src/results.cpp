// SPDX-FileCopyrightText: 2026 The fcl_kios authors
// SPDX-License-Identifier: BSD-3-Clause
#include "results.h"

#include <limits>
#include <vector>

#include "arrays.h"

namespace kios::python {
namespace {

/// The caller's geometry that FCL names: FCL may swap the two.
py::object geometryOf(const fcl::CollisionGeometryd* geometry, Object& a, Object& b) {
  return geometry == a.object.collisionGeometry().get() ? a.geometry : b.geometry;
}

}  // namespace

py::object ofFcl(const char* name) { return py::module_::import("fcl_kios.fcl").attr(name); }

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
  if (found.isCollision()) {
    result.attr("is_collision") = true;
    const py::object contact_class = ofFcl("Contact");
    const py::object add = result.attr("contacts").attr("append");
    for (std::size_t i = 0; i < found.numContacts(); ++i) {
      const fcl::Contactd& contact = found.getContact(i);
      const py::object made = contact_class();
      made.attr("o1") = geometryOf(contact.o1, a, b);
      made.attr("o2") = contact.o1 == contact.o2 ? b.geometry : geometryOf(contact.o2, a, b);
      made.attr("b1") = contact.b1;
      made.attr("b2") = contact.b2;
      made.attr("normal") = toArray(contact.normal);
      made.attr("pos") = toArray(contact.pos);
      made.attr("penetration_depth") = contact.penetration_depth;
      add(made);
    }
  }
  std::vector<fcl::CostSourced> costs;
  found.getCostSources(costs);
  for (const fcl::CostSourced& cost : costs) {
    const py::object made = ofFcl("CostSource")();
    made.attr("aabb_min") = toArray(cost.aabb_min);
    made.attr("aabb_max") = toArray(cost.aabb_max);
    made.attr("cost_density") = cost.cost_density;
    made.attr("total_cost") = cost.total_cost;
    result.attr("cost_sources").attr("append")(made);
  }
}

void assign(const fcl::DistanceResultd& found, Object& a, Object& b, py::handle result) {
  result.attr("min_distance") = found.min_distance;
  py::list points;
  for (const Eigen::Vector3d& point : found.nearest_points) points.append(toArray(point));
  result.attr("nearest_points") = points;
  result.attr("o1") = geometryOf(found.o1, a, b);
  result.attr("o2") = found.o1 == found.o2 ? b.geometry : geometryOf(found.o2, a, b);
  result.attr("b1") = found.b1;
  result.attr("b2") = found.b2;
}

}  // namespace kios::python
