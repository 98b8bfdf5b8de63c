// SPDX-FileCopyrightText: 2026 The fcl_kios authors
// SPDX-License-Identifier: BSD-3-Clause
//
// python-fcl's collide, distance and continuousCollide, and its two default callbacks.
#include <algorithm>
#include <limits>
#include <memory>
#include <utility>

#include <fcl/narrowphase/continuous_collision_request.h>
#include <fcl/narrowphase/continuous_collision_result.h>

#include "fcl_kios/overloads.h"
#include "results.h"

namespace kios::python {
namespace {

py::object orNew(py::object value, const char* class_name) {
  return value.is_none() ? ofFcl(class_name)() : value;
}

/// Ctrl-C ends long lists of contacts.
std::size_t collideInterruptibly(Object& o1, Object& o2, const fcl::CollisionRequestd& request,
                                 fcl::CollisionResultd& result) {
  constexpr std::size_t kSome = 1000;
  fcl::CollisionRequestd first = request;
  first.num_max_contacts = std::min(request.num_max_contacts, kSome);
  Reading reading = readingBoth(o1, o2);
  {
    const WithoutGil released;
    const std::size_t contacts = fcl::collide(&o1.object, &o2.object, first, result);
    if (contacts < kSome || request.num_max_contacts == kSome) return contacts;
  }
  // There are many, and they are listed anew, in a thread that may outlive this call.
  struct Kept {
    py::object o1, o2;
    fcl::CollisionResultd result;
    std::size_t contacts = 0;
  };
  const auto kept = std::make_shared<Kept>(Kept{o1.self(), o2.self(), {}});
  readInterruptibly(std::move(reading), kept,
                    [list = kept.get(), a = &o1.object, b = &o2.object, request] {
                      list->contacts = fcl::collide(a, b, request, list->result);
                    });
  result = kept->result;
  return kept->contacts;
}

std::size_t collide(Object& o1, Object& o2, py::object request, py::object result) {
  requireServed(Query::kCollide, o1.object, o2.object);
  const fcl::CollisionRequestd asked = collisionRequest(request);
  fcl::CollisionResultd found;
  const std::size_t contacts = collideInterruptibly(o1, o2, asked, found);
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
    const Reading reading = readingBoth(o1, o2);
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
    const Reading reading = readingBoth(o1, o2);
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
  const py::object request = cdata.attr(interned("request")),
                   result = cdata.attr(interned("result"));
  collide(o1, o2, request, result);
  if (enough(collisionRequest(request), py::len(result.attr(interned("contacts"))))) {
    cdata.attr("done") = true;
    return true;
  }
  return false;
}

/// Whether a manager may stop, and the distance beyond which pairs don't matter.
py::tuple defaultDistanceCallback(Object& o1, Object& o2, py::handle cdata) {
  const py::object result = cdata.attr(interned("result"));
  const double before = minDistance(result);
  if (attribute<bool>(cdata, "done")) return py::make_tuple(true, before);
  distance(o1, o2, cdata.attr(interned("request")), result, before);
  const double d = minDistance(result);
  return py::make_tuple(d <= 0, d);
}

}  // namespace

bool enough(const fcl::CollisionRequestd& request, std::size_t contacts) {
  return !request.enable_cost && contacts > request.num_max_contacts;
}

void bindQueries(py::module_& m) {
  const py::none none;
  const auto o1 = py::arg("o1").none(false), o2 = py::arg("o2").none(false);
  const auto request = py::arg("request") = none, result = py::arg("result") = none;
  m.def(
      "collide", &collide, o1, o2, request, result,
      "collide(o1, o2, request=None, result=None)\n--\n\n"
      "The number of contacts of two CollisionObjects: at most request.num_max_contacts, which are "
      "appended to\nresult.contacts. Points, normals and depths are in the world, in the models' "
      "units.");
  m.def(
      "distance",
      [](Object& a, Object& b, py::handle asked, py::handle found) {
        return distance(a, b, asked, found, std::numeric_limits<double>::max());
      },
      o1, o2, request, result,
      "distance(o1, o2, request=None, result=None)\n--\n\n"
      "The distance of two CollisionObjects in the models' units: 0 at contact, and minus a depth "
      "for "
      "solids\nwhere request.enable_signed_distance is true. A result keeps the least.");
  m.def(
      "continuousCollide", &continuousCollide, o1, py::arg("tf1_end"), o2, py::arg("tf2_end"),
      request, result,
      "continuousCollide(o1, tf1_end, o2, tf2_end, request=None, result=None)\n--\n\n"
      "The time of contact, from 0 to 1, of two CollisionObjects on their way to Transforms; 1 if "
      "there is\nnone, as result.is_collide tells.");
  m.def("defaultCollisionCallback", &defaultCollisionCallback, o1, o2, py::arg("cdata"),
        "defaultCollisionCallback(o1, o2, cdata)\n--\n\n"
        "Collides a pair for a CollisionData. Whether a manager may stop.");
  m.def("defaultDistanceCallback", &defaultDistanceCallback, o1, o2, py::arg("cdata"),
        "defaultDistanceCallback(o1, o2, cdata)\n--\n\n"
        "The distance of a pair for a DistanceData. Whether a manager may stop, and the least so "
        "far.");
}

}  // namespace kios::python
