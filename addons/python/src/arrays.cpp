// SPDX-FileCopyrightText: 2026 The fcl_kios authors
// SPDX-License-Identifier: BSD-3-Clause
#include "arrays.h"

#include <cmath>
#include <cstdint>
#include <stdexcept>
#include <string>

namespace kios::python {
namespace {

std::string shapeOf(const py::array& array) { return py::str(array.attr("shape")); }
std::string dtypeOf(const py::array& array) { return py::str(array.dtype()); }

/// `what` begins with a space, or with the [index] of what is wrong.
[[noreturn]] void refuse(const std::string& name, const std::string& what) {
  throw std::invalid_argument("fcl_kios: " + name + what);
}

constexpr int kAligned = 0x0100;  // numpy's NPY_ARRAY_ALIGNED
using Doubles = py::array_t<double, py::array::c_style | py::array::forcecast | kAligned>;
using Indices = py::array_t<std::int64_t, py::array::c_style | py::array::forcecast | kAligned>;

/// numpy's view of whatever it takes; what it doesn't, such as a ragged list, is refused.
py::array arrayOf(py::handle value, const char* name) {
  py::array array = py::array::ensure(value);
  if (!array) {
    PyErr_Clear();
    refuse(name, " is no array.");
  }
  return array;
}

template <typename Array>
Array converted(const py::array& array, const char* name) {
  Array result = Array::ensure(array);
  if (!result) {
    PyErr_Clear();
    refuse(name, " of dtype " + dtypeOf(array) + " can't be converted.");
  }
  return result;
}

bool isWritten(py::handle value) { return !py::isinstance<py::array>(value); }

}  // namespace

py::array_t<double> doubles(py::handle value, const char* name) {
  const py::array array = arrayOf(value, name);
  const char kind = array.dtype().kind();
  if (kind == 'f' && (array.itemsize() == 4 || array.itemsize() == 8)) {
    return converted<Doubles>(array, name);
  }
  if (kind == 'i' || kind == 'u' || (isWritten(value) && array.size() == 0)) {
    Doubles result = converted<Doubles>(array, name);
    for (py::ssize_t i = 0; i < result.size(); ++i) {
      if (std::abs(result.data()[i]) > 0x1p53) refuse(name, " has integers that no double holds.");
    }
    return result;
  }
  refuse(name, " has dtype " + dtypeOf(array) + "; float64, float32 or integers are needed.");
}

Points::Points(py::handle value, const char* name) : array(doubles(value, name)) {
  single = array.ndim() == 1 && array.shape(0) == 3;
  if (!single && !(array.ndim() == 2 && array.shape(1) == 3)) {
    refuse(name, " has shape " + shapeOf(array) + "; (n, 3) or (3,) is needed.");
  }
  size = single ? 1 : static_cast<std::size_t>(array.shape(0));
  data = array.data();
}

Poses::Poses(py::handle value, const char* name) {
  if (value.is_none()) {
    array = py::array_t<double>({4, 4});
    Eigen::Map<Eigen::Matrix4d>(array.mutable_data()).setIdentity();
  } else {
    array = doubles(value, name);
  }
  single = array.ndim() == 2;
  const int first = single ? 0 : 1;
  if ((array.ndim() != 2 && array.ndim() != 3) || array.shape(first) != 4 ||
      array.shape(first + 1) != 4) {
    refuse(name, " has shape " + shapeOf(array) + "; (n, 4, 4) or (4, 4) is needed.");
  }
  size = single ? 1 : static_cast<std::size_t>(array.shape(0));
  data = array.data();
  for (std::size_t i = 0; i < size; ++i) {
    const double* const row = data + 16 * i + 12;
    constexpr double kTolerance = 1e-9;
    const double off =
        std::abs(row[0]) + std::abs(row[1]) + std::abs(row[2]) + std::abs(row[3] - 1);
    if (!(off <= kTolerance)) {
      refuse(name, "[" + std::to_string(i) + "] is no pose: its last row isn't (0, 0, 0, 1).");
    }
  }
}

fcl::Transform3d Poses::operator[](std::size_t i) const {
  const double* const m = data + 16 * i;
  fcl::Transform3d X;
  X.matrix() << m[0], m[1], m[2], m[3], m[4], m[5], m[6], m[7], m[8], m[9], m[10], m[11], 0, 0, 0,
      1;
  return X;
}

fcl::Transform3d Poses::only(const char* name) const {
  if (!single) refuse(name, " must be one pose, (4, 4).");
  return (*this)[0];
}

std::vector<fcl::Vector3d> readVertices(py::handle value, const char* name) {
  const py::array_t<double> array = doubles(value, name);
  if (array.ndim() != 2 || array.shape(1) != 3) {
    refuse(name, " has shape " + shapeOf(array) + "; (n, 3) is needed.");
  }
  std::vector<fcl::Vector3d> vertices(static_cast<std::size_t>(array.shape(0)));
  const double* at = array.data();
  for (std::size_t i = 0; i < vertices.size(); ++i, at += 3) {
    vertices[i] = {at[0], at[1], at[2]};
    if (!vertices[i].allFinite()) refuse(name, "[" + std::to_string(i) + "] is not finite.");
  }
  return vertices;
}

std::vector<fcl::Triangle> readTriangles(py::handle value, const char* name,
                                         std::size_t num_vertices) {
  const py::array raw = arrayOf(value, name);
  const char kind = raw.dtype().kind();
  if (kind != 'i' && kind != 'u' && !(isWritten(value) && raw.size() == 0)) {
    refuse(name, " has dtype " + dtypeOf(raw) + "; integers are needed.");
  }
  if (raw.ndim() != 2 || raw.shape(1) != 3) {
    refuse(name, " has shape " + shapeOf(raw) + "; (m, 3) is needed.");
  }
  const Indices array = converted<Indices>(raw, name);
  std::vector<fcl::Triangle> triangles(static_cast<std::size_t>(array.shape(0)));
  const std::int64_t* at = array.data();
  for (std::size_t i = 0; i < triangles.size(); ++i, at += 3) {
    std::size_t corners[3];
    for (int k = 0; k < 3; ++k) {
      corners[k] = static_cast<std::size_t>(at[k]);  // a negative one is larger than all
      if (corners[k] >= num_vertices) {
        refuse(name, "[" + std::to_string(i) + "] refers to vertex " + std::to_string(at[k]) +
                         ", but there are " + std::to_string(num_vertices) + ".");
      }
    }
    triangles[i].set(corners[0], corners[1], corners[2]);
  }
  return triangles;
}

std::vector<double> numbers(py::handle value, py::ssize_t n, const char* what) {
  const auto array = py::array_t<double, py::array::c_style | py::array::forcecast>::ensure(value);
  if (!array) {
    PyErr_Clear();
    throw py::type_error(std::string(what) + ": numbers are needed.");
  }
  if (array.size() != n) {
    throw std::invalid_argument(std::string(what) + ": " + std::to_string(n) +
                                " numbers are needed, not " + std::to_string(array.size()) + ".");
  }
  return {array.data(), array.data() + n};
}
Eigen::Vector3d vector(py::handle value, const char* what) {
  return Eigen::Vector3d(numbers(value, 3, what).data());
}

namespace {

/// The nearest rotation (Higham 1986, Newton's iteration for the polar factor) of a matrix that was
/// rounded to few decimals; others stay as they are. Queries refuse what is left that isn't rigid.
Eigen::Matrix3d asRotation(const Eigen::Matrix3d& R) {
  constexpr double kRounded = 1e-6, kSkewed = 1e-2;  // of floats, and of two decimals
  const double error = (R.transpose() * R - Eigen::Matrix3d::Identity()).norm();
  if (!(error > kRounded && error < kSkewed)) return R;
  Eigen::Matrix3d nearest = R;
  for (int i = 0; i < 4; ++i) {  // squares the error each time
    nearest = 0.5 * (nearest + Eigen::Matrix3d(nearest.inverse().transpose()));
  }
  return nearest;
}

}  // namespace

Eigen::Matrix3d matrix(py::handle value, const char* what) {
  const std::vector<double> m = numbers(value, 9, what);
  return asRotation(Eigen::Map<const Eigen::Matrix<double, 3, 3, Eigen::RowMajor>>(m.data()));
}
Eigen::Matrix3d rotation(py::handle value, const char* what) {
  const std::vector<double> q = numbers(value, 4, what);
  return asRotation(Eigen::Quaterniond(q[0], q[1], q[2], q[3]).toRotationMatrix());
}
py::array_t<double> toMatrix(const Eigen::Matrix3d& m) {
  const Eigen::Matrix<double, 3, 3, Eigen::RowMajor> rows = m;
  return py::array_t<double>({3, 3}, rows.data());
}
py::array_t<double> toQuaternion(const Eigen::Matrix3d& m) {
  const Eigen::Quaterniond q(m);
  const double wxyz[4] = {q.w(), q.x(), q.y(), q.z()};
  return py::array_t<double>(4, wxyz);
}

py::array_t<double> toArray(const Eigen::Vector3d& v) { return py::array_t<double>(3, v.data()); }

}  // namespace kios::python
