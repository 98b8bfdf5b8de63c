// SPDX-FileCopyrightText: 2026 The fcl_kios authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <array>
#include <cmath>
#include <string>
#include <vector>

#include "fcl_kios/triangle.h"
#include "scenes/cad_shapes.h"
#include "scenes/motions.h"
#include "scenes/random.h"
#include "scenes/shapes.h"

// Meshes and poses that tests of several folders share.

namespace kios::testing {

using scenes::Mesh;
using scenes::Random;

/// Holds a mesh in the precision of a query.
template <typename S>
struct MeshIn {
  std::vector<fcl::Vector3<S>> vertices;
  std::vector<fcl::Triangle> triangles;

  explicit MeshIn(const Mesh& mesh) : triangles(mesh.triangles) {
    for (const fcl::Vector3d& p : mesh.vertices) vertices.push_back(p.template cast<S>());
  }
  TriangleVertices<S> corners(std::size_t t) const {
    const fcl::Triangle& ids = triangles[t];
    return {vertices[ids[0]], vertices[ids[1]], vertices[ids[2]]};
  }
};

struct NamedMesh {
  std::string name;
  Mesh mesh;
};

inline void addTriangle(Mesh& mesh, const fcl::Vector3d& a, const fcl::Vector3d& b,
                        const fcl::Vector3d& c) {
  const std::size_t n = mesh.vertices.size();
  mesh.vertices.insert(mesh.vertices.end(), {a, b, c});
  mesh.triangles.emplace_back(n, n + 1, n + 2);
}

/// Returns a number uniform in [-1, 1]^3.
inline fcl::Vector3d inCube(Random& random) {
  const double x = random.uniform(-1, 1), y = random.uniform(-1, 1);
  return {x, y, random.uniform(-1, 1)};
}

inline Mesh transformed(Mesh mesh, double scale, const fcl::Vector3d& offset) {
  for (fcl::Vector3d& p : mesh.vertices) p = scale * p + offset;
  return mesh;
}

/// Returns vertices on a grid, so much coarser than the mathematical library errs that its last
/// bits, which vary by machine, don't matter.
inline Mesh rounded(Mesh mesh, double grid) {
  for (fcl::Vector3d& p : mesh.vertices) {
    for (int i = 0; i < 3; ++i) p[i] = std::nearbyint(p[i] / grid) * grid;
  }
  return mesh;
}

/// A random pose by sums, products and quotients alone: the quaternion is of small whole numbers.
inline fcl::Transform3d wholePose(Random& random, double half_width) {
  std::array<double, 4> q;
  double squared;
  do {
    squared = 0;
    for (double& c : q) {
      c = std::floor(random.uniform(-20, 21));
      squared += c * c;
    }
  } while (squared == 0);
  const auto [w, x, y, z] = q;
  const double rows[3][3] = {
      {w * w + x * x - y * y - z * z, 2 * (x * y - w * z), 2 * (x * z + w * y)},
      {2 * (x * y + w * z), w * w - x * x + y * y - z * z, 2 * (y * z - w * x)},
      {2 * (x * z - w * y), 2 * (y * z + w * x), w * w - x * x - y * y + z * z}};
  fcl::Transform3d X = fcl::Transform3d::Identity();
  for (int i = 0; i < 3; ++i) {
    for (int j = 0; j < 3; ++j) X(i, j) = rows[i][j] / squared;
    X(i, 3) = std::floor(random.uniform(-half_width, half_width) * 0x1p20) * 0x1p-20;
  }
  return X;
}

/// Returns points (0), segments (1) and proper triangles (2), mixed if `kind` is 3.
inline Mesh degenerateMesh(int count, int kind, std::uint64_t seed) {
  Random random(seed);
  std::vector<Mesh> parts;
  for (int i = 0; i < count; ++i) {
    const int what = kind == 3 ? i % 3 : kind;
    const fcl::Vector3d p = inCube(random), d = 0.3 * inCube(random), e = 0.3 * inCube(random);
    if (what == 0) parts.push_back(scenes::singleTriangle(p, p, p));
    if (what == 1) parts.push_back(scenes::singleTriangle(p, p + d, p + 0.5 * d));
    if (what == 2) parts.push_back(scenes::singleTriangle(p, p + d, p + e));
  }
  return scenes::merged(parts);
}

/// Repeats a triangle `count` times, over the same three vertices.
inline Mesh repeated(int count) {
  Mesh mesh = scenes::singleTriangle({0.3, 0.1, -0.2}, {-0.4, 0.7, 0.1}, {0.2, -0.5, 0.6});
  mesh.triangles.resize(count, mesh.triangles[0]);
  return mesh;
}

/// Returns a flat grid of n x n squares of side `step`, each of two triangles, in the plane z = 0.
inline Mesh lattice(int n, double step) {
  Mesh mesh;
  for (int y = 0; y <= n; ++y) {
    for (int x = 0; x <= n; ++x) mesh.vertices.emplace_back(step * x, step * y, 0);
  }
  const auto at = [n](int x, int y) { return static_cast<std::size_t>(y * (n + 1) + x); };
  for (int y = 0; y < n; ++y) {
    for (int x = 0; x < n; ++x) {
      mesh.triangles.emplace_back(at(x, y), at(x + 1, y), at(x, y + 1));
      mesh.triangles.emplace_back(at(x + 1, y), at(x + 1, y + 1), at(x, y + 1));
    }
  }
  return mesh;
}

/// Returns meshes of extent about 1 of every kind that a partition meets.
inline std::vector<NamedMesh> unitMeshes() {
  using namespace scenes;
  const Mesh torus = bumpyTorus(300);
  std::vector<NamedMesh> meshes = {
      {"torus", torus},
      {"soup of a torus", soup(torus)},
      {"shrunk soup", shrunkSoup(torus, 1e-6, 0.1, 5)},
      {"sheet", sheet(2, 1.5, 9, 8, 0)},
      {"strips", stripCylinder(40, 0.6, 0.004)},
      {"poles", uvSphere(1, 8, 40)},
      {"repeated triangle", repeated(40)},
      {"repeated triangle, own vertices", soup(repeated(40))},
      {"points", degenerateMesh(30, 0, 6)},
      {"segments", degenerateMesh(30, 1, 7)},
      {"points, segments, triangles", degenerateMesh(60, 3, 8)},
      {"two parts", merged({icosphere(0.5, 1), transformed(icosphere(0.3, 1), 1, {40, -30, 20})})},
      {"large and small",
       merged({subdividedBox({2, 2, 2}, 2), transformed(icosphere(1, 1), 1e-4, {0.3, 0.4, 1.1})})},
      {"small flat part",
       merged({icosphere(1, 1), transformed(sheet(1, 1, 5, 5, 0), 1e-5, {0.7, 0.9, 1.1})})}};
  for (const int n : {1, 2, 7, 8, 9, 16, 17, 33, 100}) {
    meshes.push_back({"soup of " + std::to_string(n), randomSoup(n, 1, 1e-3, 1, 20 + n)});
  }
  return meshes;
}

/// Returns those, and some of them at other scales and away from their origin.
template <typename S>
std::vector<NamedMesh> allMeshes() {
  std::vector<NamedMesh> meshes = unitMeshes();
  const double offset = sizeof(S) == sizeof(double) ? 1e9 : 1e3;
  const Mesh torus = scenes::bumpyTorus(300);
  meshes.push_back({"far off", transformed(torus, 1, {offset, -2 * offset, offset / 2})});
  meshes.push_back({"tiny", transformed(torus, 1e-9, fcl::Vector3d::Zero())});
  meshes.push_back({"huge", transformed(torus, 1e9, fcl::Vector3d::Zero())});
  meshes.push_back({"tiny soup", transformed(scenes::randomSoup(60, 1, 1e-4, 1, 9), 1e-9,
                                             fcl::Vector3d(1e-6, 0, -1e-7))});
  return meshes;
}

/// Returns it swayed by about a tenth of its size, and turned. Equal vertices stay equal.
inline Mesh swayed(Mesh mesh) {
  fcl::Vector3d low = mesh.vertices[0], high = low;
  for (const fcl::Vector3d& p : mesh.vertices) {
    low = low.cwiseMin(p);
    high = high.cwiseMax(p);
  }
  const double size = (high - low).maxCoeff();
  if (!(size > 0)) return mesh;
  const fcl::Matrix3d turn =
      Eigen::AngleAxisd(0.7, fcl::Vector3d(1, -2, 0.5).normalized()).toRotationMatrix();
  for (fcl::Vector3d& p : mesh.vertices) {
    const fcl::Vector3d u = (p - low) / size;
    const fcl::Vector3d sway(std::sin(6 * u[1]), std::cos(4 * u[2]), std::sin(5 * u[0]));
    p = low + size * (turn * (u + 0.06 * sway));
  }
  return mesh;
}

/// Returns the diagonal of the box of two triangles, by which errors are measured.
template <typename S>
double extentOf(const TriangleVertices<S>& p, const TriangleVertices<S>& q) {
  Point<S> low = p[0], high = p[0];
  for (const auto* t : {&p, &q}) {
    for (const Point<S>& v : *t) {
      low = low.cwiseMin(v);
      high = high.cwiseMax(v);
    }
  }
  return (high - low).template cast<double>().stableNorm();
}

}  // namespace kios::testing
