// SPDX-FileCopyrightText: 2026 The fcl_kios authors
// SPDX-License-Identifier: BSD-3-Clause
//
// python-fcl's collide, distance and continuousCollide, and its two default callbacks.
#include <algorithm>
#include <limits>

#include <fcl/narrowphase/continuous_collision_request.h>
#include <fcl/narrowphase/continuous_collision_result.h>

#include "fcl_kios/overloads.h"
#include "results.h"

namespace kios::python {
namespace {

py::object orNew(py::object value, const char* class_name) {
  return value.is_none() ? ofFcl(class_name)() : value;
}

std::size_t collide(Object& o1, Object& o2, py::object request, py::object result) {
  requireServed(Query::kCollide, o1.object, o2.object);
  const fcl::CollisionRequestd asked = collisionRequest(request);
  fcl::CollisionResultd found;
  std::size_t contacts = 0;
  {
    const ReadingObject reading1(o1), reading2(o2);
    const WithoutGil released;
    contacts = fcl::collide(&o1.object, &o2.object, asked, found);
  }
  if (!result.is_none()) append(found, o1, o2, result);
  return contacts;
}

/// Sets nothing of a result that isn't nearer than `bound`.
double distance(Object& o1, Object& o2, py::handle request, py::handle result, double bound) {
  requireServed(Query::kDistance, o1.object, o2.object);
  const fcl::DistanceRequestd asked = distanceRequest(request);
  fcl::DistanceResultd found = emptyResult(bound);
  double d = 0;
  {
    const ReadingObject reading1(o1), reading2(o2);
    const WithoutGil released;
    d = fcl::distance(&o1.object, &o2.object, asked, found);
  }
  if (!result.is_none() && found.min_distance < minDistance(result)) assign(found, o1, o2, result);
  return d;
}

double continuousCollide(Object& o1, py::handle tf1_end, Object& o2, py::handle tf2_end,
                         py::object request, py::object result) {
  request = orNew(std::move(request), "ContinuousCollisionRequest");
  const fcl::ContinuousCollisionRequestd asked(
      attribute<std::size_t>(request, "num_max_iterations"), attribute<double>(request, "toc_err"),
      static_cast<fcl::CCDMotionType>(attribute<int>(request, "ccd_motion_type")),
      static_cast<fcl::GJKSolverType>(attribute<int>(request, "gjk_solver_type")),
      static_cast<fcl::CCDSolverType>(attribute<int>(request, "ccd_solver_type")));
  const bool advances = asked.ccd_solver_type == fcl::CCDC_CONSERVATIVE_ADVANCEMENT;
  requireServed(advances ? Query::kContinuous : Query::kCollide, o1.object, o2.object);
  const fcl::Transform3d end1 = transformOf(tf1_end), end2 = transformOf(tf2_end);
  fcl::ContinuousCollisionResultd found;
  double time = 0;
  {
    const ReadingObject reading1(o1), reading2(o2);
    const WithoutGil released;
    time = fcl::continuousCollide(&o1.object, end1, &o2.object, end2, asked, found);
  }
  if (!result.is_none()) {
    if (found.is_collide) result.attr("is_collide") = true;
    const double before = attribute<double>(result, "time_of_contact");
    result.attr("time_of_contact") = std::min(found.time_of_contact, before);
  }
  return time;
}

/// Whether a manager may stop.
bool defaultCollisionCallback(Object& o1, Object& o2, py::handle cdata) {
  if (attribute<bool>(cdata, "done")) return true;
  const py::object request = cdata.attr("request"), result = cdata.attr("result");
  collide(o1, o2, request, result);
  if (enough(collisionRequest(request), py::len(result.attr("contacts")))) {
    cdata.attr("done") = true;
    return true;
  }
  return false;
}

/// Whether a manager may stop, and the distance beyond which pairs don't matter.
py::tuple defaultDistanceCallback(Object& o1, Object& o2, py::handle cdata) {
  const py::object result = cdata.attr("result");
  const double before = minDistance(result);
  if (attribute<bool>(cdata, "done")) return py::make_tuple(true, before);
  distance(o1, o2, cdata.attr("request"), result, before);
  const double d = minDistance(result);
  return py::make_tuple(d <= 0, d);
}

}  // namespace

bool enough(const fcl::CollisionRequestd& request, std::size_t contacts) {
  return !request.enable_cost && contacts > request.num_max_contacts;
}

void bindQueries(py::module_& m) {
  const py::none none;
  m.def("collide", &collide, py::arg("o1").none(false), py::arg("o2").none(false),
        py::arg("request") = none, py::arg("result") = none);
  m.def(
      "distance",
      [](Object& o1, Object& o2, py::handle request, py::handle result) {
        return distance(o1, o2, request, result, std::numeric_limits<double>::max());
      },
      py::arg("o1").none(false), py::arg("o2").none(false), py::arg("request") = none,
      py::arg("result") = none);
  m.def("continuousCollide", &continuousCollide, py::arg("o1").none(false), py::arg("tf1_end"),
        py::arg("o2").none(false), py::arg("tf2_end"), py::arg("request") = none,
        py::arg("result") = none);
  m.def("defaultCollisionCallback", &defaultCollisionCallback, py::arg("o1").none(false),
        py::arg("o2").none(false), py::arg("cdata"));
  m.def("defaultDistanceCallback", &defaultDistanceCallback, py::arg("o1").none(false),
        py::arg("o2").none(false), py::arg("cdata"));
}

}  // namespace kios::python
