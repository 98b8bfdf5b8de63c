// SPDX-FileCopyrightText: 2026 The fcl_kios authors
// SPDX-License-Identifier: BSD-3-Clause
#include <algorithm>
#include <cmath>
#include <optional>
#include <stdexcept>
#include <string>
#include <utility>
#include <vector>

#include "fcl_kios/distance.h"
#include "fcl_kios/overloads.h"
#include "fcl_kios/solids.h"
#include "mesh_batches.h"
#include "results.h"
#include "turns.h"
#include "without_gil.h"

namespace kios::python {
namespace {

/// The second body of a pair: a mesh, or one of python-fcl's geometries, which it keeps from
/// changing meanwhile.
struct Other {
  explicit Other(py::handle other) : object(py::reinterpret_borrow<py::object>(other)) {
    if (py::isinstance<Mesh>(other)) {
      const auto& mesh = other.cast<const Mesh&>();
      geometry = model = &mesh.model();
      unchanging = &mesh;
      is_solid = mesh.isSolid();
      return;
    }
    if (!py::isinstance<fcl::CollisionGeometryd>(other)) {
      throw py::type_error("other must be a Mesh or a geometry of fcl_kios.fcl.");
    }
    geometry = &other.cast<const fcl::CollisionGeometryd&>();
    model = dynamic_cast<const Modeld*>(geometry);
    reading.emplace(&turnsOf(*geometry));
    is_solid = model && kios::isSolid(*model);
  }

  py::object object;
  const fcl::CollisionGeometryd* geometry;
  const Modeld* model = nullptr;
  const Mesh* unchanging = nullptr;
  bool is_solid = false;
  std::optional<Reading> reading;
};

/// The poses of a batch, and whose they are: of a list each has an equal share, in its order.
struct Asked {
  /// `meshes` names the query that needs them.
  Asked(py::handle other, py::handle X_AB, const char* meshes = nullptr) : poses(X_AB, "X_AB") {
    if (py::isinstance<py::list>(other)) {
      for (const py::handle each : other) others.emplace_back(each);
    } else {
      others.emplace_back(other);
    }
    for (const Other& each : others) {
      if (meshes && !each.model) {
        throw py::type_error(std::string(meshes) + ": other must be a mesh.");
      }
    }
    share = std::max<std::size_t>(1, poses.size / std::max<std::size_t>(1, others.size()));
  }
  const Other& operator[](std::size_t i) const { return others[i / share]; }
  std::size_t size() const { return poses.size; }
  /// Asks about each pose; an array of the answers, or a tuple of what they have `of`.
  template <typename Ask, typename... Of>
  py::object each(const BatchOptions& options, const Ask& ask, const Of&... of) const {
    const auto found =
        runEach(size(), options, "X_AB", [&](std::size_t i) { return ask((*this)[i], poses[i]); });
    if constexpr (sizeof...(of) == 0) {
      return column(found, poses.single);
    } else {
      return columns(found, poses.single, of...);
    }
  }

  Poses poses;
  std::vector<Other> others;
  std::size_t share;
};

const fcl::Transform3d& identity() {
  static const fcl::Transform3d X = fcl::Transform3d::Identity();
  return X;
}

bool touch(const Modeld& a, const Other& b, const fcl::Transform3d& X_AB) {
  fcl::CollisionResultd result;
  return fcl::collide(&a, identity(), b.geometry, X_AB, fcl::CollisionRequestd(), result) > 0;
}

/// A distance and, if there are any, where it is attained, in A's frame.
struct Nearest {
  double distance = kInfinity;
  Eigen::Vector3d point_a = Eigen::Vector3d::Constant(kNaN), point_b = point_a;
  std::intptr_t triangle_a = -1, triangle_b = -1;
};

double nonNegative(double value, const char* name) {
  if (value >= 0) return value;
  throw std::invalid_argument(std::string("fcl_kios: ") + name + " must be at least 0.");
}

py::object collides(const Mesh& self, py::handle other, py::handle X_AB,
                    const BatchOptions& options) {
  const Modeld& a = self.model();
  const Asked asked(other, X_AB);
  const InsideGrid* grid = nullptr;
  const SpreadVertices* spread = nullptr;
  if (asked.others.size() == 1 && asked.others[0].unchanging) {
    const Mesh& b = *asked.others[0].unchanging;
    const WithoutGil released;
    grid = self.gridFor(asked.size(), b);
    if (grid) spread = &b.spreadVertices();
  }
  return asked.each(options, [&](const Other& b, const fcl::Transform3d& X) {
    return (spread && spread->crosses(*grid, X)) || touch(a, b, X);
  });
}

py::object distance(const Mesh& self, py::handle other, py::handle X_AB, double rel_err,
                    double abs_err, double within, bool points, const BatchOptions& options) {
  const Modeld& a = self.model();
  const Asked asked(other, X_AB);
  nonNegative(within, "within");
  DistanceBracketRequestd how;
  how.rel_err = nonNegative(rel_err, "rel_err");
  how.abs_err = nonNegative(abs_err, "abs_err");
  how.far_enough = std::nextafter(within, kInfinity);
  how.nearest_points = points;
  const auto ask = [&](const Other& b, const fcl::Transform3d& X) -> Nearest {
    if (!b.model) {
      fcl::DistanceRequestd request(points);
      request.rel_err = rel_err;
      request.abs_err = abs_err;
      fcl::DistanceResultd found = emptyResult(how.far_enough);
      fcl::distance(&a, identity(), b.geometry, X, request, found);
      if (!(found.min_distance <= within)) return {};
      const bool swapped = found.o1 != &a;  // as an octree and a mesh are
      return {found.min_distance, found.nearest_points[swapped], found.nearest_points[!swapped],
              swapped ? found.b2 : found.b1, -1};
    }
    const DistanceBracketResultd found = kios::distanceBracket(a, identity(), *b.model, X, how);
    // One that lies in the other has no nearest points.
    if (self.isSolid() && b.is_solid && found.distance > 0 && touch(a, b, X)) return {0};
    if (!(found.distance <= within)) return {};
    return {found.distance, found.point_a, found.point_b, found.triangle_a, found.triangle_b};
  };
  if (!points) {
    return asked.each(options, [&](const Other& b, const auto& X) { return ask(b, X).distance; });
  }
  return asked.each(options, ask, &Nearest::distance, &Nearest::point_a, &Nearest::point_b,
                    &Nearest::triangle_a, &Nearest::triangle_b);
}

py::object bracket(const Mesh& self, py::handle other, py::handle X_AB, double rel_err,
                   double abs_err, const BatchOptions& options) {
  const Modeld& a = self.model();
  const Asked asked(other, X_AB, "bracket");
  DistanceBracketRequestd how;
  how.rel_err = nonNegative(rel_err, "rel_err");
  how.abs_err = nonNegative(abs_err, "abs_err");
  how.nearest_points = false;
  using Bracket = std::pair<double, double>;
  const auto ask = [&](const Other& b, const fcl::Transform3d& X) -> Bracket {
    if (self.isSolid() && b.is_solid && touch(a, b, X)) return {0, 0};
    const DistanceBracketResultd found = kios::distanceBracket(a, identity(), *b.model, X, how);
    return {found.lower_bound, found.upper_bound};
  };
  return asked.each(options, ask, &Bracket::first, &Bracket::second);
}

py::object closerThan(const Mesh& self, py::handle other, double t, py::handle X_AB,
                      const BatchOptions& options) {
  const Modeld& a = self.model();
  const Asked asked(other, X_AB, "closer_than");
  return asked.each(options, [&](const Other& b, const fcl::Transform3d& X) {
    return kios::closerThan(a, identity(), *b.model, X, t) ||
           (self.isSolid() && b.is_solid && t >= 0 && touch(a, b, X));
  });
}

/// By pose: its number, points, normals, depths, triangles of both.
py::object contacts(const Mesh& self, py::handle other, py::handle X_AB, std::size_t most,
                    const BatchOptions& options) {
  const Modeld& a = self.model();
  const Asked asked(other, X_AB);
  using Contact = std::pair<std::size_t, fcl::Contactd>;
  std::vector<Contact> found = flatten(runEach(asked.size(), options, "X_AB", [&](std::size_t i) {
    fcl::CollisionResultd result;
    fcl::collide(&a, identity(), asked[i].geometry, asked.poses[i], {most, true}, result);
    std::vector<fcl::Contactd> contacts;
    result.getContacts(contacts);
    return contacts;
  }));
  for (auto& [i, contact] : found) {
    if (contact.o1 != &a) {  // as an octree and a mesh are
      std::swap(contact.b1, contact.b2);
      contact.normal = -contact.normal;
    }
    if (!asked[i].model) contact.b2 = -1;
  }
  const auto of = [](const auto member) {
    return [member](const Contact& c) { return c.second.*member; };
  };
  return columns(found, false, &Contact::first, of(&fcl::Contactd::pos), of(&fcl::Contactd::normal),
                 of(&fcl::Contactd::penetration_depth), of(&fcl::Contactd::b1),
                 of(&fcl::Contactd::b2));
}

py::object penetration(const Mesh& self, py::handle other, py::handle X_AB, double rel_gap,
                       int max_tests, const BatchOptions& options) {
  const Modeld& a = self.model();
  PenetrationRequest how;
  how.rel_gap = rel_gap;
  how.max_tests = max_tests;
  const auto ask = [&](const Other& b, const fcl::Transform3d& X) {
    return kios::penetration(a, identity(), *b.model, X, how);
  };
  using Result = PenetrationResult;
  return Asked(other, X_AB, "penetration")
      .each(options, ask, &Result::lower, &Result::upper, &Result::translation, &Result::point);
}

/// Bounds, points, nearest points, whose surface the points are of, whether the bracket closed.
py::object localDepth(const Mesh& self, py::handle other, py::handle X_AB, double tolerance,
                      double rel_err, double threshold, long long max_pieces,
                      const BatchOptions& options) {
  const Modeld& a = self.model();
  LocalDepthRequest how;
  how.tolerance = tolerance;
  how.rel_err = rel_err;
  how.threshold = threshold;
  how.max_pieces = max_pieces;
  const auto ask = [&](const Other& b, const fcl::Transform3d& X) {
    return kios::localDepth(a, identity(), *b.model, X, how);
  };
  using Result = LocalDepthResult;
  return Asked(other, X_AB, "local_depth")
      .each(options, ask, &Result::lower, &Result::upper, &Result::point, &Result::nearest,
            &Result::surface_of, &Result::complete);
}

py::object deeperThan(const Mesh& self, py::handle other, double t, py::handle X_AB,
                      long long max_pieces, const BatchOptions& options) {
  const Modeld& a = self.model();
  return Asked(other, X_AB, "deeper_than")
      .each(options, [&](const Other& b, const fcl::Transform3d& X) {
        return kios::deeperThan(a, identity(), *b.model, X, t, max_pieces);
      });
}

}  // namespace

void bindPairBatches(MeshClass& c) {
  c.def("_collides", &collides)
      .def("_distance", &distance)
      .def("_bracket", &bracket)
      .def("_closer_than", &closerThan)
      .def("_contacts", &contacts)
      .def("_penetration", &penetration)
      .def("_local_depth", &localDepth)
      .def("_deeper_than", &deeperThan);
}

}  // namespace kios::python
