// SPDX-FileCopyrightText: 2026 The fcl_kios authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstddef>
#include <limits>

#include "arrays.h"
#include "batch.h"
#include "mesh.h"

// The batches of fcl_kios.Mesh. Poses X_AB are of `other` in the mesh's frame, X_WM of the mesh in
// the frame of points and rays. Each returns an array, or an item where one was asked about.

namespace kios::python {

constexpr double kInfinity = std::numeric_limits<double>::infinity();
constexpr double kNaN = std::numeric_limits<double>::quiet_NaN();

py::object collides(const Mesh& self, py::handle other, py::handle X_AB,
                    const BatchOptions& options);
py::object distance(const Mesh& self, py::handle other, py::handle X_AB, double rel_err,
                    double abs_err, double within, bool points, const BatchOptions& options);
py::object bracket(const Mesh& self, py::handle other, py::handle X_AB, double rel_err,
                   double abs_err, const BatchOptions& options);
py::object closerThan(const Mesh& self, py::handle other, double t, py::handle X_AB,
                      const BatchOptions& options);
py::object penetration(const Mesh& self, py::handle other, py::handle X_AB, double rel_gap,
                       int max_tests, const BatchOptions& options);
py::object contains(const Mesh& self, py::handle points, py::handle X_WM,
                    const BatchOptions& options);
/// t_min and t_max are lengths.
py::object rays(const Mesh& self, py::handle origins, py::handle directions, py::handle X_WM,
                double t_min, double t_max, const BatchOptions& options);
py::object raysBlocked(const Mesh& self, py::handle origins, py::handle directions, py::handle X_WM,
                       double t_min, double t_max, const BatchOptions& options);

/// A class of the package.
inline py::object ofPackage(const char* name) { return py::module_::import("fcl_kios").attr(name); }

template <typename T>
py::array_t<T> makeArray(std::size_t n) {
  return py::array_t<T>(static_cast<py::ssize_t>(n));
}
inline py::array_t<double> makeVectors(std::size_t n) {
  return py::array_t<double>({static_cast<py::ssize_t>(n), py::ssize_t{3}});
}

/// The array, or what it holds where one pose, point or ray was asked about.
inline py::object orItem(const py::array& array, bool single) {
  return single ? array[py::int_(0)].attr("item")() : py::object(array);
}
inline py::object orVector(const py::array& array, bool single) {
  return single ? py::object(array[py::int_(0)]) : py::object(array);
}

inline void write(const Eigen::Vector3d& v, double* to) {
  for (int c = 0; c < 3; ++c) to[c] = v[c];
}

}  // namespace kios::python
