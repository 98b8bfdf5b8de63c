// SPDX-FileCopyrightText: 2026 The fcl_kios authors
// SPDX-License-Identifier: BSD-3-Clause
//
// python-fcl's geometries, transforms and objects.
#include <cstring>
#include <memory>
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

#include "arrays.h"
#include "fcl_kios/model.h"
#include "fcl_kios/solids.h"
#include "fcl_kios/storage.h"
#include "files/octomap.h"
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
        awaitGeometry(g, "geometry");
        g.*member = value;
      });
}
template <typename T>
void property(Class<T>& c, const char* name, Eigen::Vector3d T::*member) {
  c.def_property(
      name, [member](const T& g) { return toArray(g.*member); },
      [member, name](T& g, py::handle value) {
        awaitGeometry(g, "geometry");
        g.*member = vector(value, name);
      });
}

/// Cones, cylinders and capsules.
template <typename T>
void bindRound(py::module_& m, const char* name, const char* text) {
  Class<T> c(m, name, text);
  c.def(py::init<double, double>(), py::arg("radius"), py::arg("lz"),
        "__init__(self, radius, lz)\n--\n\nAlong z, about the origin; lz is the length.");
  property(c, "radius", &T::radius);
  property(c, "lz", &T::lz);
}

/// Half-spaces and planes.
template <typename T>
void bindFlat(py::module_& m, const char* name, const char* text) {
  Class<T> c(m, name, text);
  c.def(py::init([](py::handle n, double d) { return std::make_shared<T>(vector(n, "n"), d); }),
        py::arg("n"), py::arg("d"), "__init__(self, n, d)\n--\n\nn: (3,); d: a length.");
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
  Class<fcl::TrianglePd> triangle(m, "TriangleP",
                                  "TriangleP(a, b, c)\n--\n\nA triangle by its corners.");
  triangle.def(py::init([](py::handle a, py::handle b, py::handle c) {
                 return std::make_shared<fcl::TrianglePd>(vector(a, "a"), vector(b, "b"),
                                                          vector(c, "c"));
               }),
               py::arg("a"), py::arg("b"), py::arg("c"),
               "__init__(self, a, b, c)\n--\n\nCorners, (3,) each.");
  property(triangle, "a", &fcl::TrianglePd::a);
  property(triangle, "b", &fcl::TrianglePd::b);
  property(triangle, "c", &fcl::TrianglePd::c);

  Class<fcl::Boxd> box(m, "Box", "Box(x, y, z)\n--\n\nA box about the origin.");
  box.def(py::init<double, double, double>(), py::arg("x"), py::arg("y"), py::arg("z"),
          "__init__(self, x, y, z)\n--\n\nIts whole lengths.");
  property(box, "side", &fcl::Boxd::side);

  Class<fcl::Sphered> sphere(m, "Sphere", "Sphere(radius)\n--\n\nA ball about the origin.");
  sphere.def(py::init<double>(), py::arg("radius"), "__init__(self, radius)\n--\n\nA length.");
  property(sphere, "radius", &fcl::Sphered::radius);

  Class<fcl::Ellipsoidd> ellipsoid(m, "Ellipsoid",
                                   "Ellipsoid(a, b, c)\n--\n\nAn ellipsoid about the origin.");
  ellipsoid.def(py::init<double, double, double>(), py::arg("a"), py::arg("b"), py::arg("c"),
                "__init__(self, a, b, c)\n--\n\nIts half axes.");
  property(ellipsoid, "radii", &fcl::Ellipsoidd::radii);

  bindRound<fcl::Capsuled>(m, "Capsule",
                           "Capsule(radius, lz)\n--\n\nA cylinder between half balls.");
  bindRound<fcl::Coned>(m, "Cone", "Cone(radius, lz)\n--\n\nA cone, its tip upwards.");
  bindRound<fcl::Cylinderd>(m, "Cylinder", "Cylinder(radius, lz)\n--\n\nA cylinder.");
  bindFlat<fcl::Halfspaced>(m, "Halfspace", "Halfspace(n, d)\n--\n\nThe points where n x <= d.");
  bindFlat<fcl::Planed>(m, "Plane", "Plane(n, d)\n--\n\nThe points where n x = d.");

  Class<fcl::Convexd>(m, "Convex", "Convex(vertices, num_faces, faces)\n--\n\nA convex polyhedron.")
      .def(py::init(&makeConvex), py::arg("vertices"), py::arg("num_faces"), py::arg("faces"),
           "__init__(self, vertices, num_faces, faces)\n--\n\nvertices: (n, 3); faces: one list of "
           "each face's number of vertices and their indices.")
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
  awaitGeometry(model, "BVHModel");
  return model;
}

Eigen::Vector3d finite(const Eigen::Vector3d& p) {
  if (!p.allFinite()) throw std::invalid_argument("BVHModel: a vertex is not finite.");
  return p;
}

bool mark_watertight = false;

/// A model that one thread builds without the GIL: queries and changes wait.
struct Building {
  explicit Building(std::shared_ptr<Modeld> of)
      : model(std::move(of)), crowd(turnsOf(*model).placed > 0) {
    count(1);
  }
  Building(const Building&) = delete;
  ~Building() { count(-1); }

  void count(int n) const {
    Turns& turns = turnsOf(*model);
    turns.readers += static_cast<unsigned int>(n);
    turns.waiting += static_cast<unsigned int>(n);
    if (crowd) crowdTurns().waiting += static_cast<unsigned int>(n);
  }

  const std::shared_ptr<Modeld> model;
  const bool crowd;
  int status = 0;
};

int endModel(const std::shared_ptr<Modeld>& model) {
  constexpr int kLong = 20000;
  const auto end = [](Modeld& g) {
    const int status = g.endModel();
    try {
      if (mark_watertight && status == fcl::BVH_OK && g.num_tris > 0) markSolid(g);
    } catch (const std::invalid_argument&) {  // it is a soup
    }
    return status;
  };
  if (changed(*model).num_tris < kLong) return end(*model);
  const auto building = std::make_shared<Building>(model);
  runInterruptibly([building = building.get(), end] { building->status = end(*building->model); },
                   building);
  return building->status;
}

void bindModel(py::module_& m) {
  m.def(
      "_mark_watertight", [](bool on) { mark_watertight = on; }, py::arg("on"));
  Class<Modeld>(
      m, "BVHModel",
      "BVHModel()\n--\n\nA mesh: beginModel(), then vertices and triangles, then endModel().")
      .def(py::init<>(), "__init__(self)\n--\n\nAn empty mesh.")
      .def(
          "num_tries_", [](const Modeld& g) { return g.num_tris; },
          "num_tries_(self)\n--\n\nThe number of triangles.")
      .def(
          "buildState", [](const Modeld& g) { return static_cast<int>(g.build_state); },
          "buildState(self)\n--\n\nFCL's state of the build: 2 once it has ended.")
      .def(
          "beginModel",
          [](Modeld& g, int num_tris, int num_vertices) {
            // Where it is 0, FCL's addTriangle() writes beyond the array.
            return changed(g).beginModel(num_tris < 1 ? -1 : num_tris, num_vertices);
          },
          py::arg("num_tris_") = 0, py::arg("num_vertices_") = 0,
          "beginModel(self, num_tris_=0, num_vertices_=0)\n--\n\nBegins to build, with room for so "
          "many. Returns FCL's code, 0.")
      .def("endModel", &endModel,
           "endModel(self)\n--\n\nBuilds what queries search. Returns FCL's code, 0 if that went "
           "well.")
      .def(
          "addVertex",
          [](Modeld& g, double x, double y, double z) {
            return checkBuild(changed(g).addVertex(finite({x, y, z})));
          },
          py::arg("x"), py::arg("y"), py::arg("z"), "addVertex(self, x, y, z)\n--\n\nAdds a point.")
      .def(
          "addTriangle",
          [](Modeld& g, py::handle v1, py::handle v2, py::handle v3) {
            return checkBuild(changed(g).addTriangle(
                finite(vector(v1, "v1")), finite(vector(v2, "v2")), finite(vector(v3, "v3"))));
          },
          py::arg("v1"), py::arg("v2"), py::arg("v3"),
          "addTriangle(self, v1, v2, v3)\n--\n\nAdds a triangle by its corners, (3,) each.")
      .def(
          "addSubModel",
          [](Modeld& g, py::handle verts, py::handle triangles) {
            const auto vertices = readVertices(verts, "verts");
            return checkBuild(changed(g).addSubModel(
                vertices, readTriangles(triangles, "triangles", vertices.size())));
          },
          py::arg("verts"), py::arg("triangles"),
          "addSubModel(self, verts, triangles)\n--\n\nAdds a mesh: (n, 3) numbers, and (m, 3) "
          "integers below n.")
      .def(
          "markSolid", [](Modeld& g) { markSolid(changed(g)); },
          "markSolid(self)\n--\n\nGives a closed mesh an inside. ValueError says where it isn't.")
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

std::string charsOf(py::handle data) {
  if (PyObject_CheckBuffer(data.ptr()) != 0) {
    return py::reinterpret_steal<py::bytes>(PyBytes_FromObject(data.ptr()));
  }
  std::string chars;
  for (const py::handle item : data) chars.push_back(static_cast<char>(item.cast<int>()));
  return chars;
}

void bindOcTree(py::module_& m) {
  Class<fcl::OcTreed>(m, "OcTree", "OcTree(r, data)\n--\n\nAn octree of octomap's.")
      .def(py::init([](double r, py::handle data) {
             return std::dynamic_pointer_cast<fcl::OcTreed>(
                 files::octreeOf(charsOf(data), false, r));
           }),
           py::arg("r"), py::arg("data"),
           "__init__(self, r, data)\n--\n\nr: the length of a cell; data: as octomap writes them, "
           "without a head.");
}

void bindGeometry(py::module_& m) {
  py::class_<Geometry, std::shared_ptr<Geometry>>(
      m, "CollisionGeometry", "CollisionGeometry()\n--\n\nWhat shapes, meshes and octrees are.")
      .def(py::init([]() -> std::shared_ptr<Geometry> { return std::make_shared<NoGeometry>(); }),
           "__init__(self)\n--\n\nNo geometry.")
      .def(
          "getNodeType",
          [](const Geometry& g) -> py::object {
            if (isNone(g)) return py::none();
            // python-fcl's meshes are over OBBRSS, and programs tell meshes by that.
            if (dynamic_cast<const Modeld*>(&g)) return py::int_(static_cast<int>(fcl::BV_OBBRSS));
            return py::int_(static_cast<int>(g.getNodeType()));
          },
          "getNodeType(self)\n--\n\nOne of NODE_TYPE.")
      .def(
          "computeLocalAABB",
          [](Geometry& g) {
            awaitGeometry(g, "geometry");
            computeLocalBox(g);
          },
          "computeLocalAABB(self)\n--\n\nTo be called after the geometry was changed.")
      .def_property(
          "aabb_center",
          [](const Geometry& g) -> py::object {
            if (isNone(g)) return py::none();
            return toArray(g.aabb_center);
          },
          [](Geometry& g, py::handle value) {
            if (isNone(g)) throw py::type_error("CollisionGeometry: there is no geometry.");
            awaitGeometry(g, "geometry");
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
