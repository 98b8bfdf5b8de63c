// SPDX-FileCopyrightText: 2026 The fcl_kios authors
// SPDX-License-Identifier: BSD-3-Clause

#include "triangle_families.h"

namespace kios::scenes {
namespace {

using Planar = std::array<Eigen::Vector2d, 3>;

struct PlanarPair {
  Planar a, b;
};

// The ways to put planar triangles into space.
enum class Plane {
  kConstantZ,  // any coordinates, z the same: coplanar exactly
  kLattice,    // integers in a plane of integer directions: coplanar exactly
  kRounded     // any plane, rounded: coplanar up to eps
};

TrianglePair inSpace(Random& random, const PlanarPair& pair, Plane plane) {
  Eigen::Vector3d origin(0, 0, 0), u(1, 0, 0), v(0, 1, 0);
  switch (plane) {
    case Plane::kConstantZ:
      origin.z() = random.uniform(-1, 1);
      break;
    case Plane::kLattice:
      origin = latticePoint(random, 9);
      u = latticePoint(random, 9);
      v = latticePoint(random, 9);
      break;
    case Plane::kRounded:
      origin = point(random);
      u = direction(random);
      v = u.cross(direction(random)).normalized();
      break;
  }
  const auto place = [&](const Planar& t) {
    Corners corners;
    for (int i = 0; i < 3; ++i) {
      // Multiples of 1/8, times 8: integers.
      const Eigen::Vector2d p =
          plane == Plane::kLattice ? Eigen::Vector2d((8 * t[i]).array().round().matrix()) : t[i];
      corners[i] = origin + p.x() * u + p.y() * v;
    }
    return corners;
  };
  TrianglePair placed = {place(pair.a), place(pair.b)};
  if (plane != Plane::kConstantZ) return placed;
  const int turn = integer(random, 0, 2);  // the constant coordinate
  return mapped(placed, [turn](const Eigen::Vector3d& p) {
    return Eigen::Vector3d(p[turn], p[(turn + 1) % 3], p[(turn + 2) % 3]);
  });
}

Eigen::Vector2d planarPoint(Random& random) {
  const double x = random.uniform(-1, 1);
  return {x, random.uniform(-1, 1)};
}

Planar planarTriangle(Random& random) {
  const Eigen::Vector2d p = planarPoint(random), q = planarPoint(random);
  return {p, q, planarPoint(random)};
}

PlanarPair overlapping(Random& random) {
  const Planar a = planarTriangle(random);
  return {a, planarTriangle(random)};
}

PlanarPair apart(Random& random) {
  PlanarPair pair = overlapping(random);
  for (Eigen::Vector2d& p : pair.b) p.x() += 2.25;
  return pair;
}

PlanarPair nested(Random& random) {
  const Planar a = planarTriangle(random);
  const Eigen::Vector2d centre = (a[0] + a[1] + a[2]) / 3;
  const double size = random.uniform(0.05, 0.9);
  Planar b = a;
  for (Eigen::Vector2d& p : b) p = centre + size * (p - centre);
  return {a, b};
}

// On both sides of the line x = 0, with a corner or an edge of each on it.
PlanarPair touching(Random& random) {
  PlanarPair pair = overlapping(random);
  for (Eigen::Vector2d& p : pair.a) p.x() = -std::abs(p.x());
  for (Eigen::Vector2d& p : pair.b) p.x() = std::abs(p.x());
  const int corners_a = integer(random, 1, 2);
  for (int i = 0; i < corners_a; ++i) pair.a[i].x() = 0;
  const int corners_b = integer(random, 1, 2);
  for (int i = 0; i < corners_b; ++i) pair.b[i].x() = 0;
  return pair;
}

// A small gap between edges that are parallel.
PlanarPair narrowGap(Random& random) {
  PlanarPair pair = touching(random);
  const double gap = logUniform(random, -52, -10);
  for (Eigen::Vector2d& p : pair.b) p.x() += gap;
  return pair;
}

auto coplanar(PlanarPair (*make)(Random&), Plane plane) {
  return [make, plane](Random& random) {
    const PlanarPair pair = make(random);
    return inSpace(random, pair, plane);
  };
}

}  // namespace

std::vector<TriangleClass> coplanarTriangles() {
  return {
      {"coplanar overlapping", coplanar(overlapping, Plane::kConstantZ)},
      {"coplanar apart", coplanar(apart, Plane::kConstantZ)},
      {"coplanar nested", coplanar(nested, Plane::kConstantZ)},
      {"coplanar touching", coplanar(touching, Plane::kConstantZ)},
      {"coplanar, narrow gap", coplanar(narrowGap, Plane::kConstantZ)},
      {"coplanar integer", coplanar(overlapping, Plane::kLattice)},
      {"coplanar integer apart", coplanar(apart, Plane::kLattice)},
      {"coplanar integer nested", coplanar(nested, Plane::kLattice)},
      {"coplanar integer touching", coplanar(touching, Plane::kLattice)},
      {"coplanar rounded", coplanar(overlapping, Plane::kRounded)},
      {"coplanar rounded apart", coplanar(apart, Plane::kRounded)},
      {"coplanar rounded nested", coplanar(nested, Plane::kRounded)},
      {"coplanar rounded touching", coplanar(touching, Plane::kRounded)},
      {"coplanar rounded, narrow", coplanar(narrowGap, Plane::kRounded)},
  };
}

}  // namespace kios::scenes
