// SPDX-FileCopyrightText: 2026 The fcl_kios authors
// SPDX-License-Identifier: BSD-3-Clause

#include "triangle_families.h"

namespace kios::scenes {
namespace {

// Segment p q as a triangle: the third corner repeats an end or, for integers, halves the segment.
Corners segment(Random& random, const Eigen::Vector3d& p, const Eigen::Vector3d& q) {
  return random.unit() < 0.5 ? Corners{p, q, p} : Corners{p, q, q};
}

Corners anySegment(Random& random) {
  const Eigen::Vector3d p = point(random);
  return segment(random, p, point(random));
}

Corners repeated(const Eigen::Vector3d& p) { return {p, p, p}; }

Corners anyPoint(Random& random) { return repeated(point(random)); }

Corners latticeTriangle(Random& random, int n) {
  const Eigen::Vector3d p = latticePoint(random, n), q = latticePoint(random, n);
  return {p, q, latticePoint(random, n)};
}

Corners lattice5(Random& random) { return latticeTriangle(random, 5); }

// Three collinear integer points, which may coincide, on the line through `on`.
Corners collinear(Random& random, const Eigen::Vector3d& on, const Eigen::Vector3d& along) {
  Corners corners;
  for (Eigen::Vector3d& p : corners) p = on + integer(random, -4, 4) * along;
  return corners;
}

Corners anyCollinear(Random& random) {
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

TrianglePair segmentsOnOneLine(Random& random) {
  const Eigen::Vector3d on = latticePoint(random, 4), along = latticePoint(random, 3);
  const Corners a = collinear(random, on, along);
  return {a, collinear(random, on, along)};
}

}  // namespace

std::vector<TriangleClass> degenerateTriangles() {
  return {
      {"segment-segment", pairOf(anySegment, anySegment)},
      {"segment-triangle", pairOf(anySegment, triangle)},
      {"point-triangle", pairOf(anyPoint, triangle)},
      {"point-segment", pairOf(anyPoint, anySegment)},
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
      {"point on face, posed", posedBy(0.125, pointOnFace)},
      {"point on edge", pointOnEdge},
      {"point on edge, posed", posedBy(0.125, pointOnEdge)},
      {"segments cross", segmentsCross},
      {"segments cross, posed", posedBy(0.125, segmentsCross)},
      {"segments on one line", segmentsOnOneLine},
      {"segments on one line, posed", posedBy(0.125, segmentsOnOneLine)},
      {"segments on parallel lines",
       [](Random& r) {
         const Eigen::Vector3d along = latticePoint(r, 3);
         const Corners a = collinear(r, latticePoint(r, 3), along);
         return TrianglePair{a, collinear(r, latticePoint(r, 3), along)};
       }},
      {"collinear triples", pairOf(anyCollinear, anyCollinear)},
      {"collinear triple, triangle", pairOf(anyCollinear, lattice5)},
      {"collinear rounded", posedBy(0.125, pairOf(anyCollinear, lattice5))},
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
