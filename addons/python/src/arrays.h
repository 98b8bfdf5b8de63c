// SPDX-FileCopyrightText: 2026 The fcl_kios authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstddef>
#include <vector>

#include <fcl/common/types.h>
#include <fcl/math/triangle.h>
#include <pybind11/numpy.h>

// numpy arrays as the queries want them. An array of the right kind is read where it lies; other
// floats and layouts are converted once. ValueError names the argument and what is wrong with it.

namespace kios::python {

namespace py = pybind11;

/// Doubles in C order, of any shape. float32 converts without loss, and so must integers; every
/// other dtype is refused.
py::array_t<double> doubles(py::handle value, const char* name);

/// (n, 3), or (3,) as one point.
struct Points {
  Points(py::handle value, const char* name);

  Eigen::Vector3d operator[](std::size_t i) const {
    return {data[3 * i], data[3 * i + 1], data[3 * i + 2]};
  }

  py::array_t<double> array;
  const double* data;
  std::size_t size;
  bool single;
};

/// (n, 4, 4), or (4, 4) or None (the identity) as one pose.
struct Poses {
  Poses(py::handle value, const char* name);

  fcl::Transform3d operator[](std::size_t i) const;
  /// The pose of which there is only one. Throws std::invalid_argument if there are several.
  fcl::Transform3d only(const char* name) const;

  py::array_t<double> array;
  const double* data;
  std::size_t size;
  bool single;
};

/// (n, 3) vertices, none of them NaN or infinite.
std::vector<fcl::Vector3d> readVertices(py::handle value, const char* name);
/// (m, 3) integers of any size, each below num_vertices.
std::vector<fcl::Triangle> readTriangles(py::handle value, const char* name,
                                         std::size_t num_vertices);

/// python-fcl takes whatever numpy converts: n numbers, of any shape. Throw TypeError for what are
/// no numbers, std::invalid_argument for another number of them.
std::vector<double> numbers(py::handle value, py::ssize_t n, const char* what);
Eigen::Vector3d vector(py::handle value, const char* what);
/// Rotations that were rounded to few decimals, of (3, 3) or a quaternion w, x, y, z, are made
/// orthonormal.
Eigen::Matrix3d matrix(py::handle value, const char* what);
Eigen::Matrix3d rotation(py::handle value, const char* what);

py::array_t<double> toArray(const Eigen::Vector3d& v);
py::array_t<double> toMatrix(const Eigen::Matrix3d& m);
/// w, x, y, z
py::array_t<double> toQuaternion(const Eigen::Matrix3d& m);

}  // namespace kios::python
