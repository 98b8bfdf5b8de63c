// SPDX-FileCopyrightText: 2026 The fcl_kios authors
// SPDX-License-Identifier: BSD-3-Clause
#include <cmath>
#include <optional>
#include <stdexcept>
#include <string>

#include "fcl_kios/overloads.h"
#include "fcl_kios/query/distance.h"
#include "fcl_kios/solid/penetration.h"
#include "fcl_kios/solid/solids.h"
#include "mesh_batches.h"
#include "results.h"
#include "without_gil.h"

namespace kios::python {
namespace {

/// The second body of a pair: a mesh, or one of python-fcl's geometries, which it keeps from
/// changing meanwhile.
struct Other {
  explicit Other(py::handle other) {
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
    reading.emplace(*geometry);
    is_solid = model && kios::isSolid(*model);
  }

  /// Throws TypeError.
  const Modeld& mesh(const char* query) const {
    if (!model) throw py::type_error(std::string(query) + ": other must be a mesh.");
    return *model;
  }

  const fcl::CollisionGeometryd* geometry;
  const Modeld* model = nullptr;
  const Mesh* unchanging = nullptr;
  bool is_solid = false;
  std::optional<ReadingGeometry> reading;
};

const fcl::Transform3d& identity() {
  static const fcl::Transform3d X = fcl::Transform3d::Identity();
  return X;
}

bool touch(const Modeld& a, const fcl::CollisionGeometryd* b, const fcl::Transform3d& X_AB) {
  fcl::CollisionResultd result;
  return fcl::collide(&a, identity(), b, X_AB, fcl::CollisionRequestd(), result) > 0;
}

/// Distances of a batch and, if asked for, where they are attained, in A's frame.
struct Nearest {
  explicit Nearest(std::size_t n, bool with_points)
      : distances(makeArray<double>(n)), distance(distances.mutable_data()) {
    if (!with_points) return;
    for (int side = 0; side < 2; ++side) {
      points[side] = makeVectors(n);
      point[side] = points[side].mutable_data();
      triangles[side] = makeArray<std::int64_t>(n);
      triangle[side] = triangles[side].mutable_data();
    }
  }

  void set(std::size_t i, double d) {
    distance[i] = d;
    if (point[0])
      set(i, d, Eigen::Vector3d::Constant(kNaN), Eigen::Vector3d::Constant(kNaN), -1, -1);
  }
  void set(std::size_t i, double d, const Eigen::Vector3d& on_a, const Eigen::Vector3d& on_b,
           std::int64_t of_a, std::int64_t of_b) {
    distance[i] = d;
    if (!point[0]) return;
    write(on_a, point[0] + 3 * i);
    write(on_b, point[1] + 3 * i);
    triangle[0][i] = of_a;
    triangle[1][i] = of_b;
  }

  py::array_t<double> distances, points[2];
  py::array_t<std::int64_t> triangles[2];
  double *distance, *point[2] = {};
  std::int64_t* triangle[2] = {};
};

double nonNegative(double value, const char* name) {
  if (value >= 0) return value;
  throw std::invalid_argument(std::string("fcl_kios: ") + name + " must be at least 0.");
}

}  // namespace

py::object collides(const Mesh& self, py::handle other, py::handle X_AB,
                    const BatchOptions& options) {
  const Modeld& a = self.model();
  const Other b(other);
  const Poses poses(X_AB, "X_AB");
  auto hits = makeArray<bool>(poses.size);
  bool* const out = hits.mutable_data();
  const InsideGrid* grid = nullptr;
  if (b.unchanging) {
    const WithoutGil released;
    grid = self.gridFor(poses.size, *b.unchanging);
  }
  const SpreadVertices* const spread = grid ? &b.unchanging->spreadVertices() : nullptr;
  runBatch(poses.size, options, "X_AB", [&](std::size_t i) {
    const fcl::Transform3d X = poses[i];
    out[i] = (spread && spread->crosses(*grid, X)) || touch(a, b.geometry, X);
  });
  return orItem(hits, poses.single);
}

py::object distance(const Mesh& self, py::handle other, py::handle X_AB, double rel_err,
                    double abs_err, double within, bool points, const BatchOptions& options) {
  const Modeld& a = self.model();
  const Other b(other);
  const Poses poses(X_AB, "X_AB");
  nonNegative(within, "within");
  DistanceOptionsd how;
  how.rel_err = nonNegative(rel_err, "rel_err");
  how.abs_err = nonNegative(abs_err, "abs_err");
  how.far_enough = std::nextafter(within, kInfinity);
  how.nearest_points = points;
  const bool solids = self.isSolid() && b.is_solid;
  Nearest nearest(poses.size, points);
  runBatch(poses.size, options, "X_AB", [&](std::size_t i) {
    const fcl::Transform3d X = poses[i];
    if (!b.model) {
      fcl::DistanceRequestd request(points);
      request.rel_err = rel_err;
      request.abs_err = abs_err;
      fcl::DistanceResultd found = emptyResult(how.far_enough);
      fcl::distance(&a, identity(), b.geometry, X, request, found);
      if (!(found.min_distance <= within)) return nearest.set(i, kInfinity);
      const bool swapped = found.o1 != &a;  // as an octree and a mesh are
      return nearest.set(i, found.min_distance, found.nearest_points[swapped],
                         found.nearest_points[!swapped], swapped ? found.b2 : found.b1, -1);
    }
    const DistanceAnswerd found = kios::distance(a, identity(), *b.model, X, how);
    // One that lies in the other has no nearest points.
    if (solids && found.distance > 0 && touch(a, b.geometry, X)) return nearest.set(i, 0);
    if (!(found.distance <= within)) return nearest.set(i, kInfinity);
    nearest.set(i, found.distance, found.point_a, found.point_b, found.triangle_a,
                found.triangle_b);
  });
  if (!points) return orItem(nearest.distances, poses.single);
  const bool single = poses.single;
  return ofPackage("Nearest")(
      orItem(nearest.distances, single), orVector(nearest.points[0], single),
      orVector(nearest.points[1], single), orItem(nearest.triangles[0], single),
      orItem(nearest.triangles[1], single));
}

py::object bracket(const Mesh& self, py::handle other, py::handle X_AB, double rel_err,
                   double abs_err, const BatchOptions& options) {
  const Modeld& a = self.model();
  const Other b(other);
  const Modeld& b_mesh = b.mesh("bracket");
  const Poses poses(X_AB, "X_AB");
  DistanceOptionsd how;
  how.rel_err = nonNegative(rel_err, "rel_err");
  how.abs_err = nonNegative(abs_err, "abs_err");
  how.nearest_points = false;
  const bool solids = self.isSolid() && b.is_solid;
  auto lower = makeArray<double>(poses.size), upper = makeArray<double>(poses.size);
  double *const lo = lower.mutable_data(), *const up = upper.mutable_data();
  runBatch(poses.size, options, "X_AB", [&](std::size_t i) {
    const fcl::Transform3d X = poses[i];
    lo[i] = up[i] = 0;
    if (solids && touch(a, b.geometry, X)) return;
    const DistanceAnswerd found = kios::distance(a, identity(), b_mesh, X, how);
    lo[i] = found.lower_bound;
    up[i] = found.upper_bound;
  });
  return ofPackage("Bracket")(orItem(lower, poses.single), orItem(upper, poses.single));
}

py::object closerThan(const Mesh& self, py::handle other, double t, py::handle X_AB,
                      const BatchOptions& options) {
  const Modeld& a = self.model();
  const Other b(other);
  const Modeld& b_mesh = b.mesh("closer_than");
  const Poses poses(X_AB, "X_AB");
  const bool solids = self.isSolid() && b.is_solid && t >= 0;
  auto verdicts = makeArray<bool>(poses.size);
  bool* const out = verdicts.mutable_data();
  runBatch(poses.size, options, "X_AB", [&](std::size_t i) {
    const fcl::Transform3d X = poses[i];
    out[i] = kios::closerThan(a, identity(), b_mesh, X, t) || (solids && touch(a, b.geometry, X));
  });
  return orItem(verdicts, poses.single);
}

py::object penetration(const Mesh& self, py::handle other, py::handle X_AB, double rel_gap,
                       int max_tests, const BatchOptions& options) {
  const Modeld& a = self.model();
  const Other b(other);
  const Modeld& b_mesh = b.mesh("penetration");
  const Poses poses(X_AB, "X_AB");
  PenetrationOptions how;
  how.rel_gap = rel_gap;
  how.max_tests = max_tests;
  auto lower = makeArray<double>(poses.size), upper = makeArray<double>(poses.size);
  auto translations = makeVectors(poses.size), points = makeVectors(poses.size);
  double *const lo = lower.mutable_data(), *const up = upper.mutable_data(),
                *const translation = translations.mutable_data(),
                *const point = points.mutable_data();
  runBatch(poses.size, options, "X_AB", [&](std::size_t i) {
    const Penetration found = kios::penetration(a, identity(), b_mesh, poses[i], how);
    lo[i] = found.lower;
    up[i] = found.upper;
    write(found.translation, translation + 3 * i);
    write(found.point, point + 3 * i);
  });
  const bool single = poses.single;
  return ofPackage("Penetration")(orItem(lower, single), orItem(upper, single),
                                  orVector(translations, single), orVector(points, single));
}

}  // namespace kios::python
