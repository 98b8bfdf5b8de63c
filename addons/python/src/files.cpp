// SPDX-FileCopyrightText: 2026 The fcl_kios authors
// SPDX-License-Identifier: BSD-3-Clause
//
// fcl_kios.load
#include <pybind11/numpy.h>
#include <pybind11/stl.h>

#include <cerrno>
#include <utility>

#include "files/read_mesh.h"
#include "objects.h"

namespace kios::python {
namespace {

/// Vertices, faces and warnings of a file.
py::tuple readFile(const std::string& file, bool weld) {
  files::Mesh mesh;
  try {
    const WithoutGil released;
    mesh = files::readMesh(file);
    if (weld) files::weld(mesh);
  } catch (const files::OpenError& error) {
    errno = error.code;
    PyErr_SetFromErrnoWithFilename(PyExc_OSError, file.c_str());
    throw py::error_already_set();
  }
  py::array_t<double> vertices({mesh.vertices.size(), std::size_t{3}},
                               mesh.vertices.data()->data());
  py::array_t<std::int64_t> faces({mesh.triangles.size(), std::size_t{3}});
  std::int64_t* to = faces.mutable_data();
  for (const fcl::Triangle& t : mesh.triangles) {
    for (const int corner : {0, 1, 2}) *to++ = static_cast<std::int64_t>(t[corner]);
  }
  return py::make_tuple(std::move(vertices), std::move(faces), mesh.warnings);
}

}  // namespace

void bindFiles(py::module_& m) { m.def("_read_file", &readFile); }

}  // namespace kios::python
