// SPDX-FileCopyrightText: 2026 The fcl_kios authors
// SPDX-License-Identifier: BSD-3-Clause

#include "triangle_families.h"

namespace kios::scenes {
namespace {

// Segment p q as a triangle: the third corner repeats an end or, for integers, halves the segment.
Corners segment(Random& random, const Eigen::Vector3d& p, const Eigen::Vector3d& q) {
  return random.unit() < 0.5 ? Corners{p, q, p} : Corners{p, q, q};
}

Corners segment(Random& random) {
  const Eigen::Vector3d p = point(random);
  return segment(random, p, point(random));
}

Corners repeated(const Eigen::Vector3d& p) { return {p, p, p}; }

Corners latticeTriangle(Random& random, int n) {
  const Eigen::Vector3d p = latticePoint(random, n), q = latticePoint(random, n);
  return {p, q, latticePoint(random, n)};
}

// Three collinear integer points, which may coincide, on the line through `on`.
Corners collinear(Random& random, const Eigen::Vector3d& on, const Eigen::Vector3d& along) {
  Corners corners;
  for (Eigen::Vector3d& p : corners) p = on + integer(random, -4, 4) * along;
  return corners;
}

Corners collinear(Random& random) {
  const Eigen::Vector3d on = latticePoint(random, 4);
  return collinear(random, on, latticePoint(random, 3));
}

TrianglePair pointOnFace(Random& random) {
  const TrianglePair contact = latticeVertexOnFace(random);
  return {contact.a, repeated(contact.b[0])};
}

TrianglePair pointOnEdge(Random& random) {
  const TrianglePair contact = latticeVertexOnEdge(random);
  return {contact.a, repeated(contact.b[0])};
}

TrianglePair segmentsCross(Random& random) {
  const TrianglePair contact = latticeEdgeThroughEdge(random);
  return {segment(random, contact.a[0], contact.a[1]), segment(random, contact.b[0], contact.b[1])};
}

auto posedContact(TrianglePair (*contact)(Random&)) {
  return [contact](Random& random) {
    const TrianglePair pair = contact(random);
    return posed(random, scaled(pair, 0.125));
  };
}

}  // namespace

std::vector<TriangleClass> degenerateTriangles() {
  return {
      {"segment-segment",
       [](Random& r) {
         return TrianglePair{segment(r), segment(r)};
       }},
      {"segment-triangle",
       [](Random& r) {
         return TrianglePair{segment(r), triangle(r)};
       }},
      {"point-triangle",
       [](Random& r) {
         return TrianglePair{repeated(point(r)), triangle(r)};
       }},
      {"point-segment",
       [](Random& r) {
         return TrianglePair{repeated(point(r)), segment(r)};
       }},
      {"point-point",
       [](Random& r) {
         const Eigen::Vector3d p = point(r), q = p + displacement(r, -60, 0);
         return TrianglePair{repeated(p), repeated(q)};
       }},
      {"same point",
       [](Random& r) {
         const Eigen::Vector3d p = point(r);
         return TrianglePair{repeated(p), repeated(p)};
       }},
      {"point on face", pointOnFace},
      {"point on face, posed", posedContact(pointOnFace)},
      {"point on edge", pointOnEdge},
      {"point on edge, posed", posedContact(pointOnEdge)},
      {"segments cross", segmentsCross},
      {"segments cross, posed", posedContact(segmentsCross)},
      {"segments on one line",
       [](Random& r) {
         const Eigen::Vector3d on = latticePoint(r, 4), along = latticePoint(r, 3);
         const Corners a = collinear(r, on, along);
         return TrianglePair{a, collinear(r, on, along)};
       }},
      {"segments on one line, posed",
       [](Random& r) {
         const Eigen::Vector3d on = latticePoint(r, 4), along = latticePoint(r, 3);
         const TrianglePair pair = {collinear(r, on, along), collinear(r, on, along)};
         return posed(r, scaled(pair, 0.125));
       }},
      {"segments on parallel lines",
       [](Random& r) {
         const Eigen::Vector3d along = latticePoint(r, 3);
         const Corners a = collinear(r, latticePoint(r, 3), along);
         return TrianglePair{a, collinear(r, latticePoint(r, 3), along)};
       }},
      {"collinear triples",
       [](Random& r) {
         return TrianglePair{collinear(r), collinear(r)};
       }},
      {"collinear triple, triangle",
       [](Random& r) {
         return TrianglePair{collinear(r), latticeTriangle(r, 5)};
       }},
      {"collinear rounded",
       [](Random& r) {
         const TrianglePair pair = {collinear(r), latticeTriangle(r, 5)};
         return posed(r, scaled(pair, 0.125));
       }},
      {"repeated vertices, lattice",
       [](Random& r) {
         TrianglePair pair = {latticeTriangle(r, 2), latticeTriangle(r, 2)};
         pair.a[2] = pair.a[integer(r, 0, 2)];
         pair.b[2] = pair.b[integer(r, 0, 2)];
         if (r.unit() < 0.3) pair.a[1] = pair.a[integer(r, 0, 2)];
         return pair;
       }},
      {"segment through face",
       [](Random& r) {
         const Corners face = triangle(r);
         const Eigen::Vector3d inside = (face[0] + face[1] + face[2]) / 3, d = point(r);
         return TrianglePair{segment(r, inside - d, inside + r.unit() * d), face};
       }},
      {"segment along face",
       [](Random& r) {
         const TrianglePair pair = latticeVertexOnFace(r);
         return TrianglePair{segment(r, pair.b[0], pair.a[integer(r, 0, 2)]), pair.a};
       }},
  };
}

}  // namespace kios::scenes
