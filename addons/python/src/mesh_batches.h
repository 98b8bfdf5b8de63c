// SPDX-FileCopyrightText: 2026 The fcl_kios authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstddef>
#include <cstdint>
#include <limits>
#include <memory>
#include <vector>

#include "arrays.h"
#include "columns.h"
#include "mesh.h"

// The batches of fcl_kios.Mesh. Poses X_AB are of `other` in the mesh's frame, X_WM of the mesh in
// the frame of points and rays: one, or one for each point or ray. Each returns an array, or an
// item where one was asked about.

namespace kios::python {

constexpr double kInfinity = std::numeric_limits<double>::infinity();
constexpr double kNaN = std::numeric_limits<double>::quiet_NaN();

using MeshClass = py::class_<Mesh, std::shared_ptr<Mesh>>;
void bindPairBatches(MeshClass& c);
void bindPointBatches(py::module_& m, MeshClass& c);
void bindRayBatches(MeshClass& c);
void bindRepair(py::module_& m, MeshClass& c);

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
