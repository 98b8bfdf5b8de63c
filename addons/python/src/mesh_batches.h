// SPDX-FileCopyrightText: 2026 The fcl_kios authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstddef>
#include <cstdint>
#include <limits>
#include <vector>

#include "arrays.h"
#include "columns.h"
#include "mesh.h"

// The batches of fcl_kios.Mesh. Poses X_AB are of `other` in the mesh's frame, X_WM of the mesh in
// the frame of points and rays. Each returns an array, or an item where one was asked about.

namespace kios::python {

constexpr double kInfinity = std::numeric_limits<double>::infinity();
constexpr double kNaN = std::numeric_limits<double>::quiet_NaN();

// `other` may be a list: of as many poses each has an equal share, in its order.
py::object collides(const Mesh& self, py::handle other, py::handle X_AB,
                    const BatchOptions& options);
py::object distance(const Mesh& self, py::handle other, py::handle X_AB, double rel_err,
                    double abs_err, double within, bool points, const BatchOptions& options);
py::object bracket(const Mesh& self, py::handle other, py::handle X_AB, double rel_err,
                   double abs_err, const BatchOptions& options);
py::object closerThan(const Mesh& self, py::handle other, double t, py::handle X_AB,
                      const BatchOptions& options);
/// By pose: its number, points, normals, depths, triangles of both.
py::object contacts(const Mesh& self, py::handle other, py::handle X_AB, std::size_t most,
                    const BatchOptions& options);
py::object penetration(const Mesh& self, py::handle other, py::handle X_AB, double rel_gap,
                       int max_tests, const BatchOptions& options);
/// Bounds, points, nearest points, whose surface the points are of, whether the bracket closed.
py::object localDepth(const Mesh& self, py::handle other, py::handle X_AB, double tolerance,
                      double rel_err, double threshold, long long max_pieces,
                      const BatchOptions& options);
py::object deeperThan(const Mesh& self, py::handle other, double t, py::handle X_AB,
                      long long max_pieces, const BatchOptions& options);
// X_WM is one pose, or one for each point or ray.
py::object contains(const Mesh& self, py::handle points, py::handle X_WM,
                    const BatchOptions& options);
/// t_min and t_max are lengths.
py::object rays(const Mesh& self, py::handle origins, py::handle directions, py::handle X_WM,
                double t_min, double t_max, const BatchOptions& options);
/// By ray: its number, triangles, distances, points, normals.
py::object raysAll(const Mesh& self, py::handle origins, py::handle directions, py::handle X_WM,
                   double t_min, double t_max, std::size_t most, const BatchOptions& options);
py::object raysBlocked(const Mesh& self, py::handle origins, py::handle directions, py::handle X_WM,
                       double t_min, double t_max, const BatchOptions& options);

/// (n, 2) triangles, and n numbers of Meeting.
py::object selfIntersectionsOf(const Mesh& self, std::size_t most);
/// Vertices, faces, vertex_of, triangle_of, a summary, and whether it bounds a solid.
py::object repaired(py::handle vertices, py::handle faces, double relative_weld,
                    double absolute_weld, int max_hole_edges, double max_hole_perimeter);

inline py::array_t<std::int64_t> toTriangles(const std::vector<fcl::Triangle>& triangles) {
  py::array_t<std::int64_t> array({triangles.size(), std::size_t{3}});
  std::int64_t* to = array.mutable_data();
  for (const fcl::Triangle& t : triangles) {
    for (const int corner : {0, 1, 2}) *to++ = static_cast<std::int64_t>(t[corner]);
  }
  return array;
}
inline py::array_t<double> toPoints(const std::vector<fcl::Vector3d>& points) {
  return py::array_t<double>({points.size(), std::size_t{3}},
                             points.empty() ? nullptr : points[0].data());
}

}  // namespace kios::python
