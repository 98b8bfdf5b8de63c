// SPDX-FileCopyrightText: 2026 The fcl_kios authors
// SPDX-License-Identifier: BSD-3-Clause
#include "fcl_kios/model.h"
#include "fcl_kios/version.h"
#include "objects.h"

PYBIND11_MODULE(_core, m) {
  namespace python = kios::python;
  m.attr("__version__") = FCL_KIOS_VERSION_STRING;
  pybind11::options options;
  options.disable_function_signatures();  // the docstrings begin with what Python reads as such
  m.def("simd_target", &kios::simdTarget,
        "simd_target()\n--\n\nThe instruction set that searches, as \"AVX2\".");
  m.def("_close", &python::WithoutGil::close);
  m.def("_before_fork", &python::WithoutGil::beforeFork);
  m.def("_after_fork", &python::WithoutGil::afterFork);
  python::bindGeometries(m);
  python::bindObjects(m);
  python::bindQueries(m);
  python::bindManager(m);
  python::bindMesh(m);
  python::bindScene(m);
  python::bindFiles(m);
#ifdef KIOS_HAVE_ROBOT
  python::bindRobot(m);
#else
  struct NoRobot {};
  pybind11::class_<NoRobot>(m, "_Robot").def(pybind11::init([](const pybind11::args&) -> NoRobot {
    throw pybind11::import_error(
        "fcl_kios.Robot was left out when fcl_kios was built: it needs libassimp-dev, "
        "libtinyxml2-dev and libyaml-cpp-dev.");
  }));
#endif
}
