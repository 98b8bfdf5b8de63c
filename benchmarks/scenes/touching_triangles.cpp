// SPDX-FileCopyrightText: 2026 The fcl_kios authors
// SPDX-License-Identifier: BSD-3-Clause

#include "triangle_families.h"

namespace kios::scenes {
namespace {

constexpr int kLattice = 8;

// Corners that are multiples of 4, so that quarters of edges and of the face are integers.
Corners latticeFace(Random& random) {
  Corners face;
  for (Eigen::Vector3d& p : face) p = 4 * latticePoint(random, kLattice);
  return face;
}

Eigen::Vector3d pointOfFace(Random& random, const Corners& f) {
  const int i = integer(random, 0, 2);
  return (2 * f[i] + f[(i + 1) % 3] + f[(i + 2) % 3]) / 4;
}

Eigen::Vector3d pointOfEdge(Random& random, const Corners& f) {
  const int i = integer(random, 0, 2), weight = integer(random, 1, 3);
  return (weight * f[i] + (4 - weight) * f[(i + 1) % 3]) / 4;
}

// p on the side of the plane through `on` to which `normal` points; exact for integers.
Eigen::Vector3d beyond(const Eigen::Vector3d& p, const Eigen::Vector3d& on,
                       const Eigen::Vector3d& normal) {
  return normal.dot(p - on) < 0 ? Eigen::Vector3d(2 * on - p) : p;
}

// A triangle with the given corner, otherwise on one side of the plane of the face.
Corners latticeCorner(Random& random, const Eigen::Vector3d& corner, const Corners& face) {
  const Eigen::Vector3d normal = (face[1] - face[0]).cross(face[2] - face[0]);
  return {corner, beyond(latticePoint(random, 4 * kLattice), corner, normal),
          beyond(latticePoint(random, 4 * kLattice), corner, normal)};
}

TrianglePair sharedVertex(Random& random) {
  TrianglePair pair = {triangle(random), triangle(random)};
  pair.b[0] = pair.a[0];
  return pair;
}

TrianglePair sharedEdge(Random& random) {
  TrianglePair pair = sharedVertex(random);
  pair.b[1] = pair.a[1];
  return pair;
}

TrianglePair latticeEdgeOnFace(Random& random) {
  const Corners face = latticeFace(random);
  Corners b = latticeCorner(random, pointOfFace(random, face), face);
  b[1] = pointOfFace(random, face);
  return {face, b};
}

TrianglePair latticeEdgeThroughVertex(Random& random) {
  const Eigen::Vector3d vertex = latticePoint(random, kLattice), d = latticePoint(random, kLattice);
  const Corners a = {vertex, latticePoint(random, kLattice), latticePoint(random, kLattice)};
  return {a,
          {vertex - integer(random, 1, 3) * d, vertex + integer(random, 1, 3) * d,
           latticePoint(random, kLattice)}};
}

// An exact contact, one triangle of it moved by an ulp in every coordinate.
TrianglePair movedByAnUlp(Random& random, TrianglePair pair) {
  const Eigen::Vector3d towards = 1e3 * direction(random);
  for (Eigen::Vector3d& p : pair.b) {
    for (int c = 0; c < 3; ++c) p[c] = std::nextafter(p[c], towards[c]);
  }
  return pair;
}

TrianglePair anyLatticeContact(Random& random) {
  switch (integer(random, 0, 4)) {
    case 0:
      return latticeVertexOnFace(random);
    case 1:
      return latticeVertexOnEdge(random);
    case 2:
      return latticeEdgeThroughEdge(random);
    case 3:
      return latticeEdgeOnFace(random);
    default:
      return latticeEdgeThroughVertex(random);
  }
}

auto lattice(int n) {
  return [n](Random& random) { return verticesFrom([&] { return latticePoint(random, n); }); };
}

}  // namespace

TrianglePair latticeVertexOnFace(Random& random) {
  const Corners face = latticeFace(random);
  const Eigen::Vector3d p = pointOfFace(random, face);
  return {face, latticeCorner(random, p, face)};
}

TrianglePair latticeVertexOnEdge(Random& random) {
  const Corners face = latticeFace(random);
  const Eigen::Vector3d p = pointOfEdge(random, face);
  return {face, latticeCorner(random, p, face)};
}

TrianglePair latticeEdgeThroughEdge(Random& random) {
  const Eigen::Vector3d c = latticePoint(random, kLattice);
  const Eigen::Vector3d d = latticePoint(random, kLattice), e = latticePoint(random, kLattice);
  const Eigen::Vector3d normal = d.cross(e);
  const Eigen::Vector3d p = latticePoint(random, kLattice), q = latticePoint(random, kLattice);
  return {{c - integer(random, 1, 4) * d, c + integer(random, 1, 4) * d, beyond(p, c, -normal)},
          {c - integer(random, 1, 4) * e, c + integer(random, 1, 4) * e, beyond(q, c, normal)}};
}

std::vector<TriangleClass> touchingTriangles() {
  return {
      {"lattice 1", lattice(1)},
      {"lattice 2", lattice(2)},
      {"lattice 4", lattice(4)},
      {"lattice 1000", lattice(1000)},
      {"vertex on face", latticeVertexOnFace},
      {"vertex on edge", latticeVertexOnEdge},
      {"edge through edge", latticeEdgeThroughEdge},
      {"edge through vertex", latticeEdgeThroughVertex},
      {"edge on face", latticeEdgeOnFace},
      {"vertex on face, posed", posedBy(1.0 / kLattice, latticeVertexOnFace)},
      {"vertex on edge, posed", posedBy(1.0 / kLattice, latticeVertexOnEdge)},
      {"edge through edge, posed", posedBy(1.0 / kLattice, latticeEdgeThroughEdge)},
      {"edge through vertex, posed", posedBy(1.0 / kLattice, latticeEdgeThroughVertex)},
      {"edge on face, posed", posedBy(1.0 / kLattice, latticeEdgeOnFace)},
      {"one ulp from contact",
       [](Random& r) { return movedByAnUlp(r, scaled(anyLatticeContact(r), 1.0 / kLattice)); }},
      {"vertex on face, rounded",
       [](Random& r) {
         TrianglePair pair = {triangle(r), triangle(r)};
         const double s = r.unit(), t = r.unit() * (1 - s);
         pair.b[0] = pair.a[0] + s * (pair.a[1] - pair.a[0]) + t * (pair.a[2] - pair.a[0]);
         return pair;
       }},
      {"vertex on edge, rounded",
       [](Random& r) {
         TrianglePair pair = {triangle(r), triangle(r)};
         pair.b[0] = pair.a[0] + r.unit() * (pair.a[1] - pair.a[0]);
         return pair;
       }},
      {"shared vertex", sharedVertex},
      {"shared vertex, rounded", [](Random& r) { return movedByAnUlp(r, sharedVertex(r)); }},
      {"shared edge", sharedEdge},
      {"shared edge, rounded", [](Random& r) { return movedByAnUlp(r, sharedEdge(r)); }},
      {"shared edge, thin fold",
       [](Random& r) {
         TrianglePair pair = sharedEdge(r);
         pair.b[2] = pair.a[2] + displacement(r, -50, -10);
         return pair;
       }},
      {"shared edge, flat",
       [](Random& r) {
         TrianglePair pair = sharedEdge(r);
         pair.b[2] = pair.a[0] + pair.a[1] - pair.a[2];
         return pair;
       }},
      {"identical",
       [](Random& r) {
         const Corners a = triangle(r);
         return TrianglePair{a, a};
       }},
      {"identical, one ulp off",
       [](Random& r) {
         const Corners a = triangle(r);
         return movedByAnUlp(r, {a, a});
       }},
      {"nearly identical",
       [](Random& r) {
         const Corners a = triangle(r);
         const double size = logUniform(r, -50, -10);
         return TrianglePair{
             a, {a[0] + size * point(r), a[1] + size * point(r), a[2] + size * point(r)}};
       }},
      {"signed zeros",
       [](Random& r) {
         return mapped(lattice(1)(r), [&r](Eigen::Vector3d p) {
           for (int c = 0; c < 3; ++c) {
             if (p[c] == 0) p[c] = std::copysign(0.0, randomSign(r));
           }
           return p;
         });
       }},
  };
}

}  // namespace kios::scenes
