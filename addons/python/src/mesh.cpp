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

#include "fcl_kios/model.h"
#include "fcl_kios/solids.h"
#include "fcl_kios/storage.h"
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

/// Ctrl-C ends long builds.
std::shared_ptr<Mesh> built(py::handle vertices, py::handle faces, bool solid) {
  constexpr std::size_t kLong = 20000;
  std::vector<fcl::Vector3d> points = readVertices(vertices, "vertices");
  std::vector<fcl::Triangle> triangles = readTriangles(faces, "faces", points.size());
  const bool is_long = triangles.size() >= kLong;
  const auto mesh = std::make_shared<std::shared_ptr<Mesh>>();
  auto build = [points = std::move(points), triangles = std::move(triangles), solid, mesh] {
    *mesh = std::make_shared<Mesh>(makeModel(points, triangles), solid);
    (*mesh)->model();
  };
  if (is_long) {
    runInterruptibly(std::move(build));
  } else {
    const WithoutGil released;
    build();
  }
  return *mesh;
}

std::size_t bytesOf(const Mesh& mesh) {
  const Modeld& model = mesh.model();
  const auto n = static_cast<std::size_t>(model.num_tris);
  const auto v = static_cast<std::size_t>(model.num_vertices);
  return (2 * n - 1) * sizeof(model.getBV(0)) + n * 28 + v * 24 + preparedBytes(model);
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

// Python's fcl_kios.Mesh, which derives from it, has the signatures and docstrings.
void bindMesh(py::module_& m) {
  MeshClass c(m, "_Mesh");
  c.def(py::init(&built))
      .def(py::init(&loaded))
      .def("_stored", &stored)
      .def("_nbytes", &bytesOf)
      .def("_is_solid", &Mesh::isSolid)
      .def("_vertices",
           [](py::object self) {
             const Modeld& model = self.cast<const Mesh&>().model();
             return view<double>(model.vertices, model.num_vertices, self);
           })
      .def("_faces", [](py::object self) {
        const Modeld& model = self.cast<const Mesh&>().model();
        return view<std::int64_t>(model.tri_indices, model.num_tris, self);
      });
  bindPairBatches(c);
  bindPointBatches(m, c);
  bindRayBatches(c);
  bindRepair(m, c);
}

}  // namespace kios::python
