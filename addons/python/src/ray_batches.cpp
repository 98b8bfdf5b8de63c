// SPDX-FileCopyrightText: 2026 The fcl_kios authors
// SPDX-License-Identifier: BSD-3-Clause
#include <optional>
#include <stdexcept>
#include <string>

#include "fcl_kios/query/ray.h"
#include "fcl_kios/solid/solids.h"
#include "mesh_batches.h"

namespace kios::python {
namespace {

/// Rays from one origin, or as many as there are directions.
struct Rays {
  Rays(py::handle o, py::handle d, double from, double to)
      : origins(o, "origins"), directions(d, "directions"), t_min(from), t_max(to) {
    if (origins.size != directions.size && !origins.single) {
      throw std::invalid_argument("fcl_kios: there are " + std::to_string(origins.size) +
                                  " origins, but " + std::to_string(directions.size) +
                                  " directions.");
    }
  }
  /// In lengths, not in directions.
  Rayd operator[](std::size_t i) const {
    Rayd ray;
    ray.origin = origins[origins.single ? 0 : i];
    ray.direction = directions[i];
    const double length = ray.direction.norm();
    ray.t_min = t_min / length;
    ray.t_max = t_max / length;
    return ray;
  }
  std::size_t size() const { return directions.size; }

  Points origins, directions;
  double t_min, t_max;
};

}  // namespace

py::object contains(const Mesh& self, py::handle points, py::handle X_WM,
                    const BatchOptions& options) {
  const Modeld& model = self.model();
  const Points asked(points, "points");
  const Poses pose(X_WM, "X_WM");
  const fcl::Transform3d X = pose.only("X_WM");
  auto inside = makeArray<bool>(asked.size);
  bool* const out = inside.mutable_data();
  runBatch(asked.size, options, "points",
           [&](std::size_t i) { out[i] = kios::contains(model, X, asked[i]); });
  return orItem(inside, asked.single);
}

py::object rays(const Mesh& self, py::handle origins, py::handle directions, py::handle X_WM,
                double t_min, double t_max, const BatchOptions& options) {
  const Modeld& model = self.model();
  const Rays asked(origins, directions, t_min, t_max);
  const Poses pose(X_WM, "X_WM");
  const fcl::Transform3d X = pose.only("X_WM");
  auto triangles = makeArray<std::int64_t>(asked.size());
  auto distances = makeArray<double>(asked.size()), points = makeVectors(asked.size());
  std::int64_t* const triangle = triangles.mutable_data();
  double *const distance = distances.mutable_data(), *const point = points.mutable_data();
  runBatch(asked.size(), options, "directions", [&](std::size_t i) {
    const Rayd ray = asked[i];
    const std::optional<RayHitd> hit = firstHit(model, X, ray);
    triangle[i] = hit ? hit->triangle : -1;
    distance[i] = hit ? hit->t * ray.direction.norm() : kInfinity;
    write(hit ? hit->point : Eigen::Vector3d::Constant(kNaN), point + 3 * i);
  });
  const bool single = asked.directions.single;
  return ofPackage("RayHits")(orItem(triangles, single), orItem(distances, single),
                              orVector(points, single));
}

py::object raysBlocked(const Mesh& self, py::handle origins, py::handle directions, py::handle X_WM,
                       double t_min, double t_max, const BatchOptions& options) {
  const Modeld& model = self.model();
  const Rays asked(origins, directions, t_min, t_max);
  const Poses pose(X_WM, "X_WM");
  const fcl::Transform3d X = pose.only("X_WM");
  auto hits = makeArray<bool>(asked.size());
  bool* const out = hits.mutable_data();
  runBatch(asked.size(), options, "directions",
           [&](std::size_t i) { out[i] = anyHit(model, X, asked[i]); });
  return orItem(hits, asked.directions.single);
}

}  // namespace kios::python
