// SPDX-FileCopyrightText: 2026 The fcl_kios authors
// SPDX-License-Identifier: BSD-3-Clause
#include "fcl_kios/model/prepare.h"
#include "fcl_kios/version.h"
#include "objects.h"

PYBIND11_MODULE(_core, m) {
  namespace python = kios::python;
  m.attr("__version__") = FCL_KIOS_VERSION_STRING;
  m.def("simd_target", &kios::simdTarget);
  m.def("_close", &python::WithoutGil::close);
  m.def("_forget", &python::WithoutGil::forget);
  python::bindGeometries(m);
  python::bindObjects(m);
  python::bindQueries(m);
  python::bindManager(m);
  python::bindMesh(m);
  python::bindScene(m);
  python::bindFiles(m);
}
