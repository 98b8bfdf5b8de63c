// SPDX-FileCopyrightText: 2026 The fcl_kios authors
// SPDX-License-Identifier: BSD-3-Clause
//
// What is wrong with a mesh, and what mends it.
#include <cstdint>
#include <memory>
#include <utility>
#include <vector>

#include "fcl_kios/repair.h"
#include "mesh_batches.h"
#include "without_gil.h"

namespace kios::python {
namespace {

/// (n, 2) triangles, and n numbers of Meeting.
py::object selfIntersectionsOf(const Mesh& self, std::size_t most) {
  const auto found = std::make_shared<std::vector<SelfIntersection>>();
  runInterruptibly(
      [model = self.share(), most, found] { *found = selfIntersections(*model, most); });
  py::array_t<std::int64_t> triangles({found->size(), std::size_t{2}});
  auto kinds = makeArray<std::int64_t>(found->size());
  std::int64_t *triangle = triangles.mutable_data(), *kind = kinds.mutable_data();
  for (const SelfIntersection& meeting : *found) {
    *triangle++ = meeting.triangle_a;
    *triangle++ = meeting.triangle_b;
    *kind++ = static_cast<std::int64_t>(meeting.kind);
  }
  return py::make_tuple(triangles, kinds);
}

/// Vertices, faces, vertex_of, triangle_of, a summary, and whether it bounds a solid.
py::object repaired(py::handle vertices, py::handle faces, double relative_weld,
                    double absolute_weld, int max_hole_edges, double max_hole_perimeter) {
  auto points = readVertices(vertices, "vertices");
  auto triangles = readTriangles(faces, "faces", points.size());
  const auto result = std::make_shared<RepairResultd>();
  runInterruptibly([=, points = std::move(points), triangles = std::move(triangles)] {
    *result = repair(points, triangles,
                     {relative_weld, absolute_weld, max_hole_edges, max_hole_perimeter});
  });
  const auto ids = [](const std::vector<int>& of) {
    return py::array_t<std::int64_t>(
        py::array_t<int>(static_cast<py::ssize_t>(of.size()), of.data()));
  };
  return py::make_tuple(toPoints(result->vertices), toTriangles(result->triangles),
                        ids(result->vertex_of), ids(result->triangle_of), summaryOf(*result),
                        result->closedness.isSolid());
}

}  // namespace

void bindRepair(py::module_& m, MeshClass& c) {
  c.def("_self_intersections", &selfIntersectionsOf);
  m.def("_repair", &repaired);
}

}  // namespace kios::python
