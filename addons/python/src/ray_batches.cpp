// SPDX-FileCopyrightText: 2026 The fcl_kios authors
// SPDX-License-Identifier: BSD-3-Clause
#include <optional>
#include <stdexcept>
#include <string>
#include <vector>

#include "fcl_kios/rays.h"
#include "fcl_kios/solids.h"
#include "mesh_batches.h"

namespace kios::python {
namespace {

/// The mesh's pose, or one for each of n queries.
struct Places {
  Places(py::handle X_WM, std::size_t n) : poses(X_WM, "X_WM") {
    if (poses.single || poses.size == n) return;
    throw std::invalid_argument("fcl_kios: there are " + std::to_string(poses.size) +
                                " poses X_WM for " + std::to_string(n) + " queries.");
  }
  fcl::Transform3d operator[](std::size_t i) const { return poses[poses.single ? 0 : i]; }

  Poses poses;
};

/// Rays from one origin, or as many as there are directions; from and to are lengths.
struct Rays {
  Rays(py::handle o, py::handle d, py::handle X_WM, double from, double to)
      : origins(o, "origins"),
        directions(d, "directions"),
        places(X_WM, directions.size),
        t_min(from),
        t_max(to) {
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
  Places places;
  double t_min, t_max;
};

/// The unit normal of a triangle in the mesh's frame; NaN where it has no area.
Eigen::Vector3d normalOf(const Modeld& mesh, int triangle) {
  const fcl::Triangle& t = mesh.tri_indices[triangle];
  const fcl::Vector3d* const v = mesh.vertices;
  const Eigen::Vector3d e1 = v[t[1]] - v[t[0]], e2 = v[t[2]] - v[t[0]];
  const Eigen::Vector3d n = e1.stableNormalized().cross(e2.stableNormalized());
  const double length = n.norm();
  return length > 0 ? Eigen::Vector3d(n / length) : Eigen::Vector3d::Constant(kNaN);
}

py::object contains(const Mesh& self, py::handle points, py::handle X_WM,
                    const BatchOptions& options) {
  const Modeld& model = self.model();
  const Points asked(points, "points");
  const Places places(X_WM, asked.size);
  return column(runEach(asked.size, options, "points",
                        [&](std::size_t i) { return kios::contains(model, places[i], asked[i]); }),
                asked.single);
}

py::object rays(const Mesh& self, py::handle origins, py::handle directions, py::handle X_WM,
                double t_min, double t_max, const BatchOptions& options) {
  const Modeld& model = self.model();
  const Rays asked(origins, directions, X_WM, t_min, t_max);
  const auto hits = runEach(asked.size(), options, "directions", [&](std::size_t i) {
    const Rayd ray = asked[i];
    std::optional<RayHitd> hit = firstHit(model, asked.places[i], ray);
    if (!hit) return RayHitd{kInfinity, Eigen::Vector3d::Constant(kNaN), {}, -1, {}};
    hit->t *= ray.direction.norm();
    return *hit;
  });
  return columns(hits, asked.directions.single, &RayHitd::triangle, &RayHitd::t, &RayHitd::point);
}

/// By ray: its number, triangles, distances, points, normals.
py::object raysAll(const Mesh& self, py::handle origins, py::handle directions, py::handle X_WM,
                   double t_min, double t_max, std::size_t most, const BatchOptions& options) {
  const Modeld& model = self.model();
  const Rays asked(origins, directions, X_WM, t_min, t_max);
  const auto hits = flatten(runEach(asked.size(), options, "directions", [&](std::size_t i) {
    return allHits(model, asked.places[i], asked[i], most);
  }));
  using Hit = std::pair<std::size_t, RayHitd>;
  return columns(
      hits, false, &Hit::first, [](const Hit& hit) { return hit.second.triangle; },
      [&](const Hit& hit) { return hit.second.t * asked.directions[hit.first].norm(); },
      [](const Hit& hit) { return hit.second.point; },
      [&](const Hit& hit) -> Eigen::Vector3d {
        return asked.places[hit.first].linear() * normalOf(model, hit.second.triangle);
      });
}

py::object raysBlocked(const Mesh& self, py::handle origins, py::handle directions, py::handle X_WM,
                       double t_min, double t_max, const BatchOptions& options) {
  const Modeld& model = self.model();
  const Rays asked(origins, directions, X_WM, t_min, t_max);
  return column(runEach(asked.size(), options, "directions",
                        [&](std::size_t i) { return anyHit(model, asked.places[i], asked[i]); }),
                asked.directions.single);
}

}  // namespace

void bindRayBatches(MeshClass& c) {
  c.def("_contains", &contains)
      .def("_rays", &rays)
      .def("_rays_all", &raysAll)
      .def("_rays_blocked", &raysBlocked);
}

}  // namespace kios::python
