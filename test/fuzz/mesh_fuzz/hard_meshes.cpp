// SPDX-FileCopyrightText: 2026 The fcl_kios authors
// SPDX-License-Identifier: BSD-3-Clause
#include "fuzz/mesh_fuzz/hard_meshes.h"

#include <algorithm>
#include <limits>
#include <utility>

#include "scenes/cad_shapes.h"
#include "scenes/shapes.h"

namespace kios::fuzz {
namespace {

void add(Mesh& mesh, const Vector3d& p, const Vector3d& q, const Vector3d& r) {
  const std::size_t first = mesh.vertices.size();
  mesh.vertices.insert(mesh.vertices.end(), {p, q, r});
  mesh.triangles.emplace_back(first, first + 1, first + 2);
}

/// Mostly few.
int countOf(Random& random) {
  if (chance(random, 0.005)) return scenes::integer(random, 60, 300);
  const double u = random.unit();
  return 1 + static_cast<int>(60 * u * u * u);
}

/// Returns a corner of a triangle near `at`, by a rule that all corners of a mesh share.
Mesh soup(Random& random, double size) {
  Mesh mesh;
  for (int i = countOf(random); i > 0; --i) {
    const Vector3d c = scenes::point(random);
    add(mesh, c, c + size * scenes::point(random), c + size * scenes::point(random));
  }
  return mesh;
}

/// Small triangles on a line, also the ends of which may be such.
Mesh dashedRod(Random& random) {
  Mesh mesh;
  const double s = chance(random, 0.2) ? 0 : power(random, -12, -1);
  const int n = scenes::integer(random, 2, 9);
  const Vector3d along = chance(random, 0.5) ? Vector3d::UnitX() : scenes::direction(random);
  const Vector3d u = along.unitOrthogonal(), v = along.cross(u);
  for (int i = 0; i < n; ++i) {
    const double x = i == 0 ? -1 - s : (i == 1 ? 1 : random.uniform(-1, 1));
    const Vector3d c = x * along;
    add(mesh, c, c + s * (along + u), c + s * (along + v));
  }
  return mesh;
}

Mesh lattice(Random& random) {
  Mesh mesh;
  const int n = scenes::integer(random, 1, 3);
  for (int i = countOf(random); i > 0; --i) {
    const Vector3d p = scenes::latticePoint(random, n), q = scenes::latticePoint(random, n);
    add(mesh, p / n, q / n, scenes::latticePoint(random, n) / n);
  }
  return mesh;
}

Mesh slivers(Random& random) {
  Mesh mesh;
  const double width = power(random, -16, -2);
  const bool alike = chance(random, 0.5);
  const Vector3d axis = scenes::direction(random);
  for (int i = countOf(random); i > 0; --i) {
    const Vector3d d = alike ? axis : scenes::direction(random), c = scenes::point(random);
    const double length = random.uniform(0.1, 1.5);
    add(mesh, c - length * d, c + length * d,
        c + random.uniform(-1, 1) * length * d + width * scenes::point(random));
  }
  return mesh;
}

/// In one plane, or in two parallel ones that are very near.
Mesh flat(Random& random) {
  Mesh mesh = chance(random, 0.5) ? soup(random, random.uniform(0.1, 1)) : lattice(random);
  const double height = chance(random, 0.7) ? 0 : power(random, -18, -3);
  for (Vector3d& p : mesh.vertices) p.z() = p.z() > 0.5 ? height : 0;
  return mesh;
}

Mesh degenerate(Random& random) {
  Mesh mesh;
  for (int i = countOf(random); i > 0; --i) {
    const Vector3d p = scenes::point(random), q = scenes::point(random);
    switch (below(random, 4)) {
      case 0:
        add(mesh, p, p, p);
        break;
      case 1:
        add(mesh, p, q, chance(random, 0.5) ? p : q);
        break;
      case 2:
        add(mesh, p, q, p + random.unit() * (q - p));
        break;
      default:
        add(mesh, p, q, scenes::point(random));
    }
  }
  return mesh;
}

/// Triangles and places of all scales.
Mesh mixedScales(Random& random) {
  Mesh mesh;
  const double least = chance(random, 0.2) ? -150 : -14;
  for (int i = countOf(random); i > 0; --i) {
    const double size = power(random, chance(random, 0.5) ? least : -3, 0);
    const double away = chance(random, 0.3) ? 0 : power(random, -12, 0);
    const Vector3d c = away * scenes::point(random);
    add(mesh, c + size * scenes::point(random), c + size * scenes::point(random),
        c + size * scenes::point(random));
  }
  return mesh;
}

Mesh closed(Random& random) {
  switch (below(random, 6)) {
    case 0:
      return scenes::icosphere(1, 0);
    case 1:
      return scenes::subdividedBox({2, 2, chance(random, 0.3) ? 1e-6 : 1}, 1);
    case 2:
      return scenes::subdividedBox({1, 0.7, 0.2}, 2);
    case 3:
      return scenes::bumpyTorus(100);
    case 4:
      return scenes::stripCylinder(scenes::integer(random, 4, 8), 0.6, power(random, -4, -1));
    default:
      return scenes::sheet(1, 1, 3, 3, chance(random, 0.5) ? 0 : 0.2);
  }
}

/// Coordinates on a grid, so that sums of them are exact.
void toGrid(Mesh& mesh, int bits) {
  for (Vector3d& p : mesh.vertices) {
    for (double& v : p) v = std::ldexp(std::round(std::ldexp(v, bits)), -bits);
  }
}

/// Two points that make 0 the exact middle of the mesh's box.
void frame(Mesh& mesh, Random& random) {
  double most = 0;
  for (const Vector3d& p : mesh.vertices) most = std::max(most, p.cwiseAbs().maxCoeff());
  const double half = std::exp2(std::ceil(std::log2(std::max(most, 1e-3))));
  for (const Vector3d& p : {Vector3d(half, half, half), Vector3d(-half, -half, -half)}) {
    const double s = chance(random, 0.7) ? 0 : half / 16;
    add(mesh, p, p - std::copysign(s, p.x()) * Vector3d::UnitX(), p);
  }
}

void copyTriangles(Mesh& mesh, Random& random) {
  for (int i = scenes::integer(random, 1, 12); i > 0; --i) {
    fcl::Triangle t = mesh.triangles[below(random, static_cast<int>(mesh.triangles.size()))];
    if (chance(random, 0.5)) std::swap(t[0], t[1]);
    if (chance(random, 0.5)) {  // with vertices of its own
      add(mesh, Vector3d(mesh.vertices[t[0]]), Vector3d(mesh.vertices[t[1]]),
          Vector3d(mesh.vertices[t[2]]));
    } else {
      mesh.triangles.push_back(t);
    }
  }
}

}  // namespace

Mesh hardMesh(Random& random) {
  Mesh mesh;
  switch (below(random, 10)) {
    case 0:
      mesh = soup(random, random.uniform(0.05, 1));
      break;
    case 1:  // specks in a wide box
      mesh = soup(random, power(random, -9, -1));
      break;
    case 2:
      mesh = dashedRod(random);
      break;
    case 3:
      mesh = lattice(random);
      break;
    case 4:
      mesh = slivers(random);
      break;
    case 5:
      mesh = flat(random);
      break;
    case 6:
      mesh = degenerate(random);
      break;
    case 7:
      mesh = mixedScales(random);
      break;
    case 8:
      add(mesh, scenes::point(random), scenes::point(random), scenes::point(random));
      break;
    default:
      mesh = closed(random);
  }
  if (chance(random, 0.2)) toGrid(mesh, scenes::integer(random, 2, 12));
  if (chance(random, 0.2)) frame(mesh, random);
  if (chance(random, 0.1)) copyTriangles(mesh, random);
  return mesh;
}

Mesh relativeOf(const Mesh& mesh, Random& random) {
  Mesh relative = mesh;
  switch (below(random, 6)) {
    case 0:
      break;
    case 1:
      place(relative, chance(random, 0.5) ? 0.25 : random.uniform(0.1, 1.1), Vector3d::Zero());
      break;
    case 2:
      place(relative, -1, Vector3d::Zero());
      break;
    case 3: {
      const double noise = power(random, -17, -2);
      for (Vector3d& p : relative.vertices) p += noise * scenes::point(random);
      break;
    }
    case 4: {
      std::vector<std::size_t> kept;
      for (std::size_t t = 0; t < mesh.triangles.size(); ++t) {
        if (kept.empty() || chance(random, 0.5)) kept.push_back(t);
      }
      return partOf(mesh, kept);
    }
    default:  // its mirror image
      for (Vector3d& p : relative.vertices) p.x() = -p.x();
  }
  return relative;
}

void place(Mesh& mesh, double scale, const Vector3d& offset) {
  for (Vector3d& p : mesh.vertices) p = scale * p + offset;
}

Vector3d middleOf(const Mesh& mesh) {
  Vector3d low = mesh.vertices[0], high = low;
  for (const fcl::Triangle& t : mesh.triangles) {
    for (int k = 0; k < 3; ++k) {
      low = low.cwiseMin(mesh.vertices[t[k]]);
      high = high.cwiseMax(mesh.vertices[t[k]]);
    }
  }
  return 0.5 * low + 0.5 * high;
}

Mesh partOf(const Mesh& mesh, const std::vector<std::size_t>& triangles) {
  constexpr std::size_t kNone = std::numeric_limits<std::size_t>::max();
  std::vector<std::size_t> place_of(mesh.vertices.size(), kNone);
  Mesh part;
  for (const std::size_t t : triangles) {
    std::size_t ids[3];
    for (int k = 0; k < 3; ++k) {
      std::size_t& id = place_of[mesh.triangles[t][k]];
      if (id == kNone) {
        id = part.vertices.size();
        part.vertices.push_back(mesh.vertices[mesh.triangles[t][k]]);
      }
      ids[k] = id;
    }
    part.triangles.emplace_back(ids[0], ids[1], ids[2]);
  }
  return part;
}

}  // namespace kios::fuzz
