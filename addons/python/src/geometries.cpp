// SPDX-FileCopyrightText: 2026 The fcl_kios authors
// SPDX-License-Identifier: BSD-3-Clause
//
// python-fcl's geometries, transforms and objects.
#include <cstring>
#include <memory>
#include <sstream>
#include <stdexcept>
#include <string>
#include <vector>

#include <fcl/geometry/octree/octree.h>
#include <fcl/geometry/shape/box.h>
#include <fcl/geometry/shape/capsule.h>
#include <fcl/geometry/shape/cone.h>
#include <fcl/geometry/shape/convex.h>
#include <fcl/geometry/shape/cylinder.h>
#include <fcl/geometry/shape/ellipsoid.h>
#include <fcl/geometry/shape/halfspace.h>
#include <fcl/geometry/shape/plane.h>
#include <fcl/geometry/shape/sphere.h>
#include <fcl/geometry/shape/triangle_p.h>
#include <octomap/OcTree.h>

#include "arrays.h"
#include "fcl_kios/model/model.h"
#include "fcl_kios/model/storage.h"
#include "fcl_kios/solid/solids.h"
#include "objects.h"

namespace kios::python {
namespace {

using Geometry = fcl::CollisionGeometryd;
template <typename T>
using Class = py::class_<T, Geometry, std::shared_ptr<T>>;

/// python-fcl's CollisionGeometry(), which stands for nothing.
class NoGeometry final : public Geometry {
 public:
  void computeLocalAABB() override {}
};

bool isNone(const Geometry& geometry) { return dynamic_cast<const NoGeometry*>(&geometry); }

/// A member that Python reads and writes, a number or three.
template <typename T>
void property(Class<T>& c, const char* name, double T::*member) {
  c.def_property(
      name, [member](const T& g) { return g.*member; },
      [member](T& g, double value) {
        requireUnread(g, "geometry");
        g.*member = value;
      });
}
template <typename T>
void property(Class<T>& c, const char* name, Eigen::Vector3d T::*member) {
  c.def_property(
      name, [member](const T& g) { return toArray(g.*member); },
      [member, name](T& g, py::handle value) {
        requireUnread(g, "geometry");
        g.*member = vector(value, name);
      });
}

/// Cones, cylinders and capsules.
template <typename T>
void bindRound(py::module_& m, const char* name) {
  Class<T> c(m, name);
  c.def(py::init<double, double>(), py::arg("radius"), py::arg("lz"));
  property(c, "radius", &T::radius);
  property(c, "lz", &T::lz);
}

/// Half-spaces and planes.
template <typename T>
void bindFlat(py::module_& m, const char* name) {
  Class<T> c(m, name);
  c.def(py::init([](py::handle n, double d) { return std::make_shared<T>(vector(n, "n"), d); }),
        py::arg("n"), py::arg("d"));
  property(c, "n", &T::n);
  property(c, "d", &T::d);
}

/// Faces are lists of indices, each behind its length: FCL reads them without a check.
std::shared_ptr<fcl::Convexd> makeConvex(py::handle vertices, int num_faces, py::handle faces) {
  using Indices = py::array_t<long long, py::array::c_style | py::array::forcecast>;
  auto points = std::make_shared<std::vector<fcl::Vector3d>>(readVertices(vertices, "vertices"));
  const Indices array = Indices::ensure(faces);
  if (!array || array.ndim() != 1) {
    PyErr_Clear();
    throw std::invalid_argument("Convex: faces must be a flat list of integers.");
  }
  auto indices = std::make_shared<std::vector<int>>();
  const auto n = static_cast<std::size_t>(array.size());
  const long long* const at = array.data();
  std::size_t next = 0;
  for (int face = 0; face < num_faces; ++face) {
    const std::string name = "Convex: face " + std::to_string(face);
    if (next >= n || at[next] < 3 || static_cast<std::size_t>(at[next]) > n - next - 1) {
      throw std::invalid_argument(name + " has no three vertices, or isn't whole.");
    }
    const std::size_t end = next + 1 + static_cast<std::size_t>(at[next]);
    indices->push_back(static_cast<int>(at[next]));
    for (++next; next < end; ++next) {
      if (at[next] < 0 || static_cast<std::size_t>(at[next]) >= points->size()) {
        throw std::invalid_argument(name + " refers to vertex " + std::to_string(at[next]) +
                                    ", but there are " + std::to_string(points->size()) + ".");
      }
      indices->push_back(static_cast<int>(at[next]));
    }
  }
  if (num_faces < 1 || next != n) {
    throw std::invalid_argument("Convex: num_faces is " + std::to_string(num_faces) +
                                ", which isn't how many faces there are.");
  }
  return std::make_shared<fcl::Convexd>(points, num_faces, indices);
}

void bindShapes(py::module_& m) {
  Class<fcl::TrianglePd> triangle(m, "TriangleP");
  triangle.def(py::init([](py::handle a, py::handle b, py::handle c) {
                 return std::make_shared<fcl::TrianglePd>(vector(a, "a"), vector(b, "b"),
                                                          vector(c, "c"));
               }),
               py::arg("a"), py::arg("b"), py::arg("c"));
  property(triangle, "a", &fcl::TrianglePd::a);
  property(triangle, "b", &fcl::TrianglePd::b);
  property(triangle, "c", &fcl::TrianglePd::c);

  Class<fcl::Boxd> box(m, "Box");
  box.def(py::init<double, double, double>(), py::arg("x"), py::arg("y"), py::arg("z"));
  property(box, "side", &fcl::Boxd::side);

  Class<fcl::Sphered> sphere(m, "Sphere");
  sphere.def(py::init<double>(), py::arg("radius"));
  property(sphere, "radius", &fcl::Sphered::radius);

  Class<fcl::Ellipsoidd> ellipsoid(m, "Ellipsoid");
  ellipsoid.def(py::init<double, double, double>(), py::arg("a"), py::arg("b"), py::arg("c"));
  property(ellipsoid, "radii", &fcl::Ellipsoidd::radii);

  bindRound<fcl::Capsuled>(m, "Capsule");
  bindRound<fcl::Coned>(m, "Cone");
  bindRound<fcl::Cylinderd>(m, "Cylinder");
  bindFlat<fcl::Halfspaced>(m, "Halfspace");
  bindFlat<fcl::Planed>(m, "Plane");

  Class<fcl::Convexd>(m, "Convex")
      .def(py::init(&makeConvex), py::arg("vertices"), py::arg("num_faces"), py::arg("faces"))
      .def_property_readonly("num_faces", &fcl::Convexd::getFaceCount)
      .def_property_readonly(
          "_vertices",
          [](const fcl::Convexd& c) {
            return py::array_t<double>(
                {static_cast<py::ssize_t>(c.getVertices().size()), py::ssize_t{3}},
                c.getVertices()[0].data());
          })
      .def_property_readonly("_faces", [](const fcl::Convexd& c) {
        return py::array_t<int>(static_cast<py::ssize_t>(c.getFaces().size()), c.getFaces().data());
      });
}

/// FCL's error codes as python-fcl raises them.
bool checkBuild(int status) {
  switch (status) {
    case fcl::BVH_OK:
      return true;
    case fcl::BVH_ERR_MODEL_OUT_OF_MEMORY:
      throw std::bad_alloc();
    case fcl::BVH_ERR_BUILD_OUT_OF_SEQUENCE:
      throw std::invalid_argument("BVHModel: call beginModel() first, once, and endModel() last.");
    case fcl::BVH_ERR_BUILD_EMPTY_MODEL:
      throw std::invalid_argument("BVHModel: there is no triangle.");
    default:
      throw std::invalid_argument("BVHModel: FCL's error " + std::to_string(status) + ".");
  }
}

Modeld& changed(Modeld& model) {
  requireUnread(model, "BVHModel");
  return model;
}

Eigen::Vector3d finite(const Eigen::Vector3d& p) {
  if (!p.allFinite()) throw std::invalid_argument("BVHModel: a vertex is not finite.");
  return p;
}

void bindModel(py::module_& m) {
  Class<Modeld>(m, "BVHModel")
      .def(py::init<>())
      .def("num_tries_", [](const Modeld& g) { return g.num_tris; })
      .def("buildState", [](const Modeld& g) { return static_cast<int>(g.build_state); })
      .def(
          "beginModel",
          [](Modeld& g, int num_tris, int num_vertices) {
            // Where it is 0, FCL's addTriangle() writes beyond the array.
            return changed(g).beginModel(num_tris < 1 ? -1 : num_tris, num_vertices);
          },
          py::arg("num_tris_") = 0, py::arg("num_vertices_") = 0)
      .def("endModel", [](Modeld& g) { return changed(g).endModel(); })
      .def(
          "addVertex",
          [](Modeld& g, double x, double y, double z) {
            return checkBuild(changed(g).addVertex(finite({x, y, z})));
          },
          py::arg("x"), py::arg("y"), py::arg("z"))
      .def(
          "addTriangle",
          [](Modeld& g, py::handle v1, py::handle v2, py::handle v3) {
            return checkBuild(changed(g).addTriangle(
                finite(vector(v1, "v1")), finite(vector(v2, "v2")), finite(vector(v3, "v3"))));
          },
          py::arg("v1"), py::arg("v2"), py::arg("v3"))
      .def(
          "addSubModel",
          [](Modeld& g, py::handle verts, py::handle triangles) {
            const auto vertices = readVertices(verts, "verts");
            return checkBuild(changed(g).addSubModel(
                vertices, readTriangles(triangles, "triangles", vertices.size())));
          },
          py::arg("verts"), py::arg("triangles"))
      .def("markSolid", [](Modeld& g) { markSolid(changed(g)); })
      .def("_is_solid", [](const Modeld& g) { return isSolid(g); })
      .def("_save",
           [](const Modeld& g) {
             const std::vector<unsigned char> bytes = save(g);
             return py::bytes(reinterpret_cast<const char*>(bytes.data()), bytes.size());
           })
      .def_static("_load", [](const py::bytes& bytes, bool solid) {
        const std::string_view view = bytes;
        auto model = load(view.data(), view.size());
        if (solid) markSolid(*model);
        return model;
      });
}

/// octomap's reader trusts its input: it recurses, and reads on, for ever. Two bytes a node hold
/// two bits a child, 3 for a child with children; at most 16 levels lie below the root.
void requireTree(const std::string& data) {
  constexpr int kLevels = 16;
  std::vector<int> levels = {0};
  std::size_t at = 0;
  while (!levels.empty()) {
    const int level = levels.back();
    levels.pop_back();
    if (data.size() - at < 2) throw std::invalid_argument("OcTree: the data end too early.");
    for (int child = 8; child-- > 0;) {  // the first is read next
      const int bits = static_cast<unsigned char>(data[at + static_cast<std::size_t>(child / 4)]) >>
                           (2 * (child % 4)) &
                       3;
      if (bits != 3) continue;
      if (level + 1 >= kLevels)
        throw std::invalid_argument("OcTree: the data have too many levels.");
      levels.push_back(level + 1);
    }
    at += 2;
  }
}

std::string charsOf(py::handle data) {
  if (PyObject_CheckBuffer(data.ptr()) != 0) {
    return py::reinterpret_steal<py::bytes>(PyBytes_FromObject(data.ptr()));
  }
  std::string chars;
  for (const py::handle item : data) chars.push_back(static_cast<char>(item.cast<int>()));
  return chars;
}

void bindOcTree(py::module_& m) {
  Class<fcl::OcTreed>(m, "OcTree")
      .def(py::init([](double r, py::handle data) {
             if (!(r > 0))
               throw std::invalid_argument("OcTree: the resolution r must be positive.");
             const std::string chars = charsOf(data);
             requireTree(chars);
             std::stringstream stream(chars);
             auto tree = std::make_shared<octomap::OcTree>(r);
             tree->readBinaryData(stream);
             return std::make_shared<fcl::OcTreed>(std::shared_ptr<const octomap::OcTree>(tree));
           }),
           py::arg("r"), py::arg("data"));
}

void bindGeometry(py::module_& m) {
  py::class_<Geometry, std::shared_ptr<Geometry>>(m, "CollisionGeometry")
      .def(py::init([]() -> std::shared_ptr<Geometry> { return std::make_shared<NoGeometry>(); }))
      .def("getNodeType",
           [](const Geometry& g) -> py::object {
             if (isNone(g)) return py::none();
             // python-fcl's meshes are over OBBRSS, and programs tell meshes by that.
             if (dynamic_cast<const Modeld*>(&g)) return py::int_(static_cast<int>(fcl::BV_OBBRSS));
             return py::int_(static_cast<int>(g.getNodeType()));
           })
      .def("computeLocalAABB",
           [](Geometry& g) {
             requireUnread(g, "geometry");
             computeLocalBox(g);
           })
      .def_property(
          "aabb_center",
          [](const Geometry& g) -> py::object {
            if (isNone(g)) return py::none();
            return toArray(g.aabb_center);
          },
          [](Geometry& g, py::handle value) {
            if (isNone(g)) throw py::type_error("CollisionGeometry: there is no geometry.");
            requireUnread(g, "geometry");
            const Eigen::Vector3d center = vector(value, "aabb_center");
            if (!center.allFinite()) throw std::invalid_argument("aabb_center is not finite.");
            g.aabb_center = center;
          });
}

}  // namespace

void bindGeometries(py::module_& m) {
  bindGeometry(m);
  bindShapes(m);
  bindModel(m);
  bindOcTree(m);
}

}  // namespace kios::python
