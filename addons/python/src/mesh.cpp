// SPDX-FileCopyrightText: 2026 The fcl_kios authors
// SPDX-License-Identifier: BSD-3-Clause
//
// fcl_kios.Mesh
#include <memory>
#include <mutex>
#include <stdexcept>
#include <string>
#include <utility>
#include <vector>

#include "fcl_kios/model/prepare.h"
#include "fcl_kios/model/storage.h"
#include "fcl_kios/solid/penetration.h"
#include "fcl_kios/solid/solids.h"
#include "mesh_batches.h"
#include "objects.h"

namespace kios::python {
namespace {

/// The array is a view that keeps `owner` alive, and that nobody may write to.
template <typename T>
py::array_t<T> view(const void* data, int rows, py::handle owner) {
  py::array_t<T> array({static_cast<py::ssize_t>(rows), py::ssize_t{3}},
                       static_cast<const T*>(data), owner);
  array.attr("setflags")(py::arg("write") = false);
  return array;
}

/// The stored model as an array that owns it.
py::array_t<unsigned char> stored(const Mesh& self) {
  auto bytes = std::make_unique<std::vector<unsigned char>>();
  {
    const WithoutGil released;
    *bytes = save(self.model());
  }
  const auto size = static_cast<py::ssize_t>(bytes->size());
  unsigned char* const data = bytes->data();
  const py::capsule owner(bytes.release(),
                          [](void* p) { delete static_cast<std::vector<unsigned char>*>(p); });
  return py::array_t<unsigned char>(size, data, owner);
}

std::shared_ptr<Mesh> loaded(const py::buffer& buffer, bool solid) {
  const py::buffer_info bytes = buffer.request();
  if (bytes.ndim > 1 || (bytes.ndim == 1 && bytes.strides[0] != bytes.itemsize)) {
    throw std::invalid_argument("fcl_kios: the stored model must be contiguous bytes.");
  }
  std::shared_ptr<Modeld> model;
  {
    const WithoutGil released;
    model = load(bytes.ptr, static_cast<std::size_t>(bytes.size * bytes.itemsize));
  }
  return std::make_shared<Mesh>(std::move(model), solid);
}

std::shared_ptr<Mesh> built(py::handle vertices, py::handle faces, bool solid) {
  const std::vector<fcl::Vector3d> points = readVertices(vertices, "vertices");
  const std::vector<fcl::Triangle> triangles = readTriangles(faces, "faces", points.size());
  std::shared_ptr<Mesh> mesh;
  {
    const WithoutGil released;
    mesh = std::make_shared<Mesh>(makeModel(points, triangles), solid);
    mesh->model();
  }
  return mesh;
}

}  // namespace

const Modeld& Mesh::model() const {
  if (solid_) std::call_once(marked_, [this] { markSolid(*model_); });
  return *model_;
}

const InsideGrid* Mesh::gridFor(std::size_t n, const Mesh& other) const {
  const std::size_t poses = poses_.fetch_add(n, std::memory_order_relaxed) + n;
  const auto triangles = static_cast<std::size_t>(model_->num_tris + other.model_->num_tris);
  // By then searches have taken about as long as a grid does.
  if (n < 64 || poses < 4096 + triangles / 3) return nullptr;
  std::call_once(grid_made_, [this] { grid_ = InsideGrid::of(*model_); });
  if (grid_) std::call_once(other.spread_made_, [&] { other.spread_.emplace(*other.model_); });
  return grid_.get();
}

void bindMesh(py::module_& m) {
  const py::none none;
  const auto threads = py::arg("threads") = none, progress = py::arg("progress") = none;
  const auto pose = py::arg("X_AB") = none, of_mesh = py::arg("X_WM") = none;
  const auto from = py::arg("t_min") = 0.0, to = py::arg("t_max") = kInfinity;
  const py::kw_only only;
  py::class_<Mesh, std::shared_ptr<Mesh>>(m, "Mesh",
                                          "A mesh that nobody changes, and batches of queries on "
                                          "it. Threads may share it, and it can be "
                                          "pickled with its trees.")
      .def(py::init(&built), py::arg("vertices"), py::arg("faces"), only, py::arg("solid") = false,
           "A mesh that nobody changes. vertices: (n, 3) floats; faces: (m, 3) integers below n. "
           "Where solid is\n"
           "true the mesh must be closed, normals outwards; then what lies in it is in contact "
           "with it.\n"
           "Raises ValueError that says what is wrong.")
      .def(
          "collides",
          [](const Mesh& self, py::handle other, py::handle X_AB, py::object threads,
             py::object progress) {
            return collides(self, other, X_AB, {std::move(threads), std::move(progress)});
          },
          py::arg("other"), pose, only, threads, progress,
          "Whether the meshes touch: exact, touching counts. other: a Mesh, or a geometry of "
          "fcl_kios.fcl;\n"
          "X_AB: its pose in this mesh's frame, (4, 4), or (n, 4, 4) of them, float64 or float32; "
          "None: the\n"
          "identity. Returns a bool, or n of them.\n"
          "\n"
          "threads: at most so many; None: all cores. progress: called, about every 20 ms, with "
          "how many\n"
          "more are done, as tqdm's update(). Both are options of every batch; no batch holds the "
          "GIL, and\n"
          "answers don't depend on threads. Raises ValueError for arrays of other shapes and "
          "dtypes, and for\n"
          "poses that aren't rigid or finite.")
      .def(
          "distance",
          [](const Mesh& self, py::handle other, py::handle X_AB, double rel_err, double abs_err,
             double within, bool points, py::object threads, py::object progress) {
            return distance(self, other, X_AB, rel_err, abs_err, within, points,
                            {std::move(threads), std::move(progress)});
          },
          py::arg("other"), pose, only, py::arg("rel_err") = 0.0, py::arg("abs_err") = 0.0,
          py::arg("within") = kInfinity, py::arg("points") = false, threads, progress,
          "Distances, 0 at contact: exact to 16 eps of the nearest triangles' extent, or at most\n"
          "max(rel_err d, abs_err) too large. Pairs farther apart than `within` are infinity, "
          "which is faster\n"
          "to find. A float, or n of them; with points=True a Nearest, whose points are in this "
          "mesh's frame.")
      .def(
          "bracket",
          [](const Mesh& self, py::handle other, py::handle X_AB, double rel_err, double abs_err,
             py::object threads, py::object progress) {
            return bracket(self, other, X_AB, rel_err, abs_err,
                           {std::move(threads), std::move(progress)});
          },
          py::arg("other"), pose, only, py::arg("rel_err") = 0.1, py::arg("abs_err") = 0.0, threads,
          progress,
          "Proven lower and upper bounds of the distances, a Bracket: at most max(rel_err d, "
          "abs_err) apart,\n"
          "to rounding. other must be a mesh.")
      .def(
          "closer_than",
          [](const Mesh& self, py::handle other, double t, py::handle X_AB, py::object threads,
             py::object progress) {
            return closerThan(self, other, t, X_AB, {std::move(threads), std::move(progress)});
          },
          py::arg("other"), py::arg("t"), pose, only, threads, progress,
          "Whether the meshes are at most t apart, as distance() <= t, but faster. other must be a "
          "mesh.")
      .def(
          "contains",
          [](const Mesh& self, py::handle points, py::handle X_WM, py::object threads,
             py::object progress) {
            return contains(self, points, X_WM, {std::move(threads), std::move(progress)});
          },
          py::arg("points"), of_mesh, only, threads, progress,
          "Whether points (n, 3), or (3,), lie in the solid or on its surface: exact. X_WM: the "
          "mesh's pose in\n"
          "the points' frame. Returns n bools, or one. Raises ValueError if the mesh is no solid.")
      .def(
          "penetration",
          [](const Mesh& self, py::handle other, py::handle X_AB, double rel_gap, int max_tests,
             py::object threads, py::object progress) {
            return penetration(self, other, X_AB, rel_gap, max_tests,
                               {std::move(threads), std::move(progress)});
          },
          py::arg("other"), pose, only, py::arg("rel_gap") = PenetrationOptions().rel_gap,
          py::arg("max_tests") = PenetrationOptions().max_tests, threads, progress,
          "How deep two solids overlap: a Penetration, whose translation moves `other` out of this "
          "one. The\n"
          "search ends once upper <= (1 + rel_gap) lower, or after so many tests; bounds are "
          "proven anyway.")
      .def(
          "rays",
          [](const Mesh& self, py::handle origins, py::handle directions, py::handle X_WM,
             double t_min, double t_max, py::object threads, py::object progress) {
            return rays(self, origins, directions, X_WM, t_min, t_max,
                        {std::move(threads), std::move(progress)});
          },
          py::arg("origins"), py::arg("directions"), of_mesh, only, from, to, threads, progress,
          "The first triangles that rays meet, RayHits. origins: (n, 3), or (3,) for all; "
          "directions: (n, 3) of\n"
          "any length but 0; X_WM: the mesh's pose in the rays' frame; t_min, t_max: lengths along "
          "the rays\n"
          "between which hits count.")
      .def(
          "rays_blocked",
          [](const Mesh& self, py::handle origins, py::handle directions, py::handle X_WM,
             double t_min, double t_max, py::object threads, py::object progress) {
            return raysBlocked(self, origins, directions, X_WM, t_min, t_max,
                               {std::move(threads), std::move(progress)});
          },
          py::arg("origins"), py::arg("directions"), of_mesh, only, from, to, threads, progress,
          "Whether the rays meet any triangle: faster than rays().")
      .def(
          "prepare",
          [](const Mesh& self) {
            const WithoutGil released;
            prepare(self.model());
          },
          "Prepares the tree that the first large batch or the first few queries would.")
      .def_property_readonly("is_solid", &Mesh::isSolid, "Whether it has an inside.")
      .def_property_readonly(
          "nbytes",
          [](const Mesh& self) {
            const Modeld& model = self.model();
            const auto n = static_cast<std::size_t>(model.num_tris);
            const auto v = static_cast<std::size_t>(model.num_vertices);
            return (2 * n - 1) * sizeof(model.getBV(0)) + n * 28 + v * 24 + preparedBytes(model);
          },
          "Bytes of memory, trees included.")
      .def_property_readonly(
          "vertices",
          [](py::object self) {
            const Modeld& model = self.cast<const Mesh&>().model();
            return view<double>(model.vertices, model.num_vertices, self);
          },
          "(n, 3) float64, read only, not copied.")
      .def_property_readonly(
          "faces",
          [](py::object self) {
            const Modeld& model = self.cast<const Mesh&>().model();
            return view<std::int64_t>(model.tri_indices, model.num_tris, self);
          },
          "(m, 3) int64, read only, not copied.")
      .def("_stored", &stored)
      .def_static("_loaded", &loaded, py::arg("buffer"), py::arg("solid"));
}

}  // namespace kios::python
