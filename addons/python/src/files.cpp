// SPDX-FileCopyrightText: 2026 The fcl_kios authors
// SPDX-License-Identifier: BSD-3-Clause
//
// fcl_kios.load
#include <pybind11/numpy.h>
#include <pybind11/stl.h>

#include <cerrno>
#include <memory>
#include <string>
#include <utility>

#include "files/read_mesh.h"
#include "mesh_batches.h"
#include "objects.h"

namespace kios::python {
namespace {

/// Vertices, faces and warnings of a file, or of what stands in its place.
py::tuple readFile(const std::string& file, bool weld, const py::object& content) {
  std::string bytes;
  if (!content.is_none()) bytes = content.cast<std::string>();
  const bool is_file = content.is_none();
  const auto mesh = std::make_shared<files::Mesh>();
  try {
    runInterruptibly([file, weld, is_file, bytes = std::move(bytes), mesh]() mutable {
      *mesh = is_file ? files::readMesh(file) : files::readMesh(file, std::move(bytes));
      if (weld) files::weld(*mesh);
    });
  } catch (const files::OpenError& error) {
    errno = error.code;
    PyErr_SetFromErrnoWithFilename(PyExc_OSError, file.c_str());
    throw py::error_already_set();
  }
  return py::make_tuple(toPoints(mesh->vertices), toTriangles(mesh->triangles), mesh->warnings);
}

}  // namespace

void bindFiles(py::module_& m) { m.def("_read_file", &readFile); }

}  // namespace kios::python
