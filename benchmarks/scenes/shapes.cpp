// SPDX-FileCopyrightText: 2026 The fcl_kios authors
// SPDX-License-Identifier: BSD-3-Clause

#include "shapes.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdlib>
#include <functional>
#include <map>
#include <utility>

#include "placement.h"
#include "random.h"

namespace kios::scenes {
namespace {

using fcl::Vector3d;

// Two triangles of the square a b c d, which runs counter-clockwise seen from outside.
void addSquare(Mesh& mesh, std::size_t a, std::size_t b, std::size_t c, std::size_t d) {
  mesh.triangles.emplace_back(a, b, c);
  mesh.triangles.emplace_back(a, c, d);
}

// Torus about z over an nu x nv periodic grid. `tube(u, v)` is the tube's radius and `lift(u)` the
// height of its centre line; u runs about z, v about the centre line, both in radians.
Mesh torus(int nu, int nv, double major, const std::function<double(double, double)>& tube,
           const std::function<double(double)>& lift) {
  Mesh mesh;
  mesh.vertices.reserve(static_cast<std::size_t>(nu) * nv);
  mesh.triangles.reserve(2 * static_cast<std::size_t>(nu) * nv);
  for (int i = 0; i < nu; ++i) {
    const double u = 2 * kPi * i / nu;
    for (int j = 0; j < nv; ++j) {
      const double v = 2 * kPi * j / nv;
      const double r = tube(u, v);
      const double rho = major + r * std::cos(v);
      mesh.vertices.emplace_back(rho * std::cos(u), rho * std::sin(u), lift(u) + r * std::sin(v));
    }
  }
  const auto vertex = [&](int i, int j) {
    return static_cast<std::size_t>(i % nu) * nv + static_cast<std::size_t>(j % nv);
  };
  for (int i = 0; i < nu; ++i) {
    for (int j = 0; j < nv; ++j) {
      addSquare(mesh, vertex(i, j), vertex(i + 1, j), vertex(i + 1, j + 1), vertex(i, j + 1));
    }
  }
  return mesh;
}

// Star-shaped surface on a latitude-longitude grid; `radius` is a function of the unit direction.
Mesh starShape(int rings, int segments, const std::function<double(const Vector3d&)>& radius) {
  Mesh mesh;
  const auto add = [&](const Vector3d& direction) {
    mesh.vertices.emplace_back(radius(direction) * direction);
  };
  for (int i = 1; i < rings; ++i) {
    const double polar = kPi * i / rings;
    for (int j = 0; j < segments; ++j) {
      const double azimuth = 2 * kPi * j / segments;
      add({std::sin(polar) * std::cos(azimuth), std::sin(polar) * std::sin(azimuth),
           std::cos(polar)});
    }
  }
  add(Vector3d::UnitZ());
  add(-Vector3d::UnitZ());
  const auto vertex = [&](int ring, int j) {
    return static_cast<std::size_t>(ring - 1) * segments + static_cast<std::size_t>(j % segments);
  };
  const std::size_t north = mesh.vertices.size() - 2;
  const std::size_t south = mesh.vertices.size() - 1;
  for (int j = 0; j < segments; ++j) {
    mesh.triangles.emplace_back(north, vertex(1, j), vertex(1, j + 1));
    for (int i = 1; i + 1 < rings; ++i) {
      addSquare(mesh, vertex(i, j), vertex(i + 1, j), vertex(i + 1, j + 1), vertex(i, j + 1));
    }
    mesh.triangles.emplace_back(south, vertex(rings - 1, j + 1), vertex(rings - 1, j));
  }
  return mesh;
}

Vector3d randomDirection(Random& random) {
  const double z = random.uniform(-1, 1);
  const double azimuth = random.uniform(0, 2 * kPi);
  const double rho = std::sqrt(1 - z * z);
  return {rho * std::cos(azimuth), rho * std::sin(azimuth), z};
}

}  // namespace

Mesh knobbyTorus() {
  return torus(
      54, 30, 0.85,
      [](double u, double v) { return 0.3 + 0.06 * std::cos(6 * u) * std::cos(3 * v); },
      [](double) { return 0.0; });
}

Mesh bentTorus() {
  return torus(
      37, 18, 0.36, [](double, double) { return 0.1; },
      [](double u) { return 0.1 * std::cos(2 * u); });
}

Mesh bumpyBlob() {
  return starShape(30, 38, [](const Vector3d& d) {
    return 0.7 + 0.12 * std::sin(3 * d.x() + 1) * std::cos(4 * d.y()) + 0.1 * std::sin(5 * d.z()) +
           0.05 * std::cos(9 * d.x()) * std::sin(8 * d.z());
  });
}

Mesh bumpyTorus(int triangles) {
  // The centre line is 2.5 times as long as the tube's circumference: near-square cells, then the
  // nearby count along it that fits the number of triangles best.
  const auto around = [triangles](int nu) {
    return std::max(3, static_cast<int>(std::lround(triangles / (2.0 * nu))));
  };
  const int square = std::max(4, static_cast<int>(std::lround(std::sqrt(triangles * 1.25))));
  int nu = square;
  for (int candidate = square * 3 / 4; candidate <= square * 5 / 4; ++candidate) {
    const auto miss = [&](int n) { return std::abs(2 * n * around(n) - triangles); };
    if (miss(candidate) < miss(nu)) nu = candidate;
  }
  const int nv = around(nu);
  return torus(
      nu, nv, 1.0,
      [](double u, double v) {
        return 0.4 + 0.04 * std::sin(7 * u) * std::cos(3 * v) + 0.02 * std::sin(11 * u + 5 * v);
      },
      [](double) { return 0.0; });
}

Mesh subdividedBox(const Vector3d& size, int n) {
  Mesh mesh;
  std::map<std::array<int, 3>, std::size_t> vertex_at;
  const auto vertex = [&](const std::array<int, 3>& cell) {
    const auto [entry, is_new] = vertex_at.try_emplace(cell, mesh.vertices.size());
    if (is_new) {
      const Vector3d fraction(cell[0], cell[1], cell[2]);
      mesh.vertices.emplace_back((fraction / n - Vector3d::Constant(0.5)).cwiseProduct(size));
    }
    return entry->second;
  };
  for (int axis = 0; axis < 3; ++axis) {
    for (const int side : {0, n}) {
      // (axis, first, second) is a right-handed frame on the upper side, a left-handed one below.
      int first = (axis + 1) % 3;
      int second = (axis + 2) % 3;
      if (side == 0) std::swap(first, second);
      const auto at = [&](int i, int j) {
        std::array<int, 3> cell{};
        cell[axis] = side;
        cell[first] = i;
        cell[second] = j;
        return vertex(cell);
      };
      for (int i = 0; i < n; ++i) {
        for (int j = 0; j < n; ++j) {
          addSquare(mesh, at(i, j), at(i + 1, j), at(i + 1, j + 1), at(i, j + 1));
        }
      }
    }
  }
  return mesh;
}

Mesh icosphere(double radius, int subdivisions) {
  const double golden = (1 + std::sqrt(5.0)) / 2;
  Mesh mesh;
  mesh.vertices = {{-1, golden, 0}, {1, golden, 0}, {-1, -golden, 0}, {1, -golden, 0},
                   {0, -1, golden}, {0, 1, golden}, {0, -1, -golden}, {0, 1, -golden},
                   {golden, 0, -1}, {golden, 0, 1}, {-golden, 0, -1}, {-golden, 0, 1}};
  mesh.triangles = {{0, 11, 5}, {0, 5, 1},  {0, 1, 7},   {0, 7, 10}, {0, 10, 11},
                    {1, 5, 9},  {5, 11, 4}, {11, 10, 2}, {10, 7, 6}, {7, 1, 8},
                    {3, 9, 4},  {3, 4, 2},  {3, 2, 6},   {3, 6, 8},  {3, 8, 9},
                    {4, 9, 5},  {2, 4, 11}, {6, 2, 10},  {8, 6, 7},  {9, 8, 1}};
  for (Vector3d& p : mesh.vertices) p *= radius / p.norm();
  for (int step = 0; step < subdivisions; ++step) {
    std::map<std::pair<std::size_t, std::size_t>, std::size_t> midpoint_of;
    const auto midpoint = [&](std::size_t a, std::size_t b) {
      const auto [entry, is_new] = midpoint_of.try_emplace(std::minmax(a, b), mesh.vertices.size());
      if (is_new) {
        const Vector3d sum = mesh.vertices[a] + mesh.vertices[b];
        mesh.vertices.emplace_back(sum * (radius / sum.norm()));
      }
      return entry->second;
    };
    std::vector<fcl::Triangle> finer;
    finer.reserve(4 * mesh.triangles.size());
    for (const fcl::Triangle& triangle : mesh.triangles) {
      const std::size_t ab = midpoint(triangle[0], triangle[1]);
      const std::size_t bc = midpoint(triangle[1], triangle[2]);
      const std::size_t ca = midpoint(triangle[2], triangle[0]);
      finer.emplace_back(triangle[0], ab, ca);
      finer.emplace_back(triangle[1], bc, ab);
      finer.emplace_back(triangle[2], ca, bc);
      finer.emplace_back(ab, bc, ca);
    }
    mesh.triangles = std::move(finer);
  }
  return mesh;
}

Mesh uvSphere(double radius, int rings, int segments) {
  return starShape(rings, segments, [radius](const Vector3d&) { return radius; });
}

Mesh sheet(double width, double depth, int nx, int ny, double amplitude) {
  Mesh mesh;
  for (int i = 0; i <= nx; ++i) {
    for (int j = 0; j <= ny; ++j) {
      const double s = static_cast<double>(i) / nx;
      const double t = static_cast<double>(j) / ny;
      mesh.vertices.emplace_back((s - 0.5) * width, (t - 0.5) * depth,
                                 amplitude * std::sin(2 * kPi * s) * std::sin(2 * kPi * t));
    }
  }
  const auto vertex = [ny](int i, int j) {
    return static_cast<std::size_t>(i) * (ny + 1) + static_cast<std::size_t>(j);
  };
  for (int i = 0; i < nx; ++i) {
    for (int j = 0; j < ny; ++j) {
      addSquare(mesh, vertex(i, j), vertex(i + 1, j), vertex(i + 1, j + 1), vertex(i, j + 1));
    }
  }
  return mesh;
}

Mesh singleTriangle(const Vector3d& a, const Vector3d& b, const Vector3d& c) {
  return {{a, b, c}, {fcl::Triangle(0, 1, 2)}};
}

Mesh randomSoup(int count, double half_width, double min_edge, double max_edge,
                std::uint64_t seed) {
  Random random(seed);
  const auto edge = [&] {
    const double length = min_edge * std::pow(max_edge / min_edge, random.unit());
    return Vector3d(length * randomDirection(random));
  };
  Mesh mesh;
  for (int i = 0; i < count; ++i) {
    const std::size_t first = mesh.vertices.size();
    const Vector3d corner = random.inCube(-half_width, half_width);
    mesh.vertices.push_back(corner);
    mesh.vertices.emplace_back(corner + edge());
    mesh.vertices.emplace_back(corner + edge());
    mesh.triangles.emplace_back(first, first + 1, first + 2);
  }
  return mesh;
}

Mesh shrunkSoup(const Mesh& mesh, double least, double most, std::uint64_t seed) {
  Random random(seed);
  Mesh result = soup(mesh);
  for (const fcl::Triangle& t : result.triangles) {
    Vector3d& a = result.vertices[t[0]];
    Vector3d& b = result.vertices[t[1]];
    Vector3d& c = result.vertices[t[2]];
    const Vector3d centroid = (a + b + c) / 3;
    const double shrink = least * std::pow(most / least, random.unit());
    for (Vector3d* p : {&a, &b, &c}) *p += shrink * (centroid - *p);
  }
  return result;
}

}  // namespace kios::scenes
