// SPDX-FileCopyrightText: 2026 The fcl_kios authors
// SPDX-License-Identifier: BSD-3-Clause

#pragma once

#include <algorithm>
#include <cmath>

#include <Eigen/Geometry>

#include "triangle_classes.h"

// Parts from which the classes of triangle pairs are made, and the families that make them.

namespace kios::scenes {

using Corners = std::array<Eigen::Vector3d, 3>;

std::vector<TriangleClass> separatedTriangles();
std::vector<TriangleClass> touchingTriangles();
std::vector<TriangleClass> coplanarTriangles();
std::vector<TriangleClass> degenerateTriangles();
std::vector<TriangleClass> scaledTriangles();

/// In [lower, upper], both included.
inline int integer(Random& random, int lower, int upper) {
  return lower + static_cast<int>(random.unit() * (upper - lower + 1));
}

/// Returns a number uniform in [1, 2) times 2^e, e uniform in [lower, upper].
inline double logUniform(Random& random, int lower, int upper) {
  const int e = integer(random, lower, upper);
  return std::ldexp(random.uniform(1, 2), e);
}

inline double randomSign(Random& random) { return random.unit() < 0.5 ? -1 : 1; }

/// In the cube [-1, 1)^3.
inline Eigen::Vector3d point(Random& random) { return random.inCube(-1, 1); }

inline Eigen::Vector3d direction(Random& random) {
  for (;;) {
    const Eigen::Vector3d p = point(random);
    if (p.squaredNorm() > 0.01 && p.squaredNorm() < 1) return p.normalized();
  }
}

/// Returns a vector of any direction and length in [2^lower, 2^(upper + 1)).
inline Eigen::Vector3d displacement(Random& random, int lower, int upper) {
  const double length = logUniform(random, lower, upper);
  return length * direction(random);
}

/// Rounded: R^T R differs from the identity by a few eps.
inline Eigen::Matrix3d rotation(Random& random) {
  Eigen::Matrix3d R;
  R.col(0) = direction(random);
  R.col(1) = R.col(0).cross(direction(random)).normalized();
  R.col(2) = R.col(0).cross(R.col(1)).normalized();
  return R;
}

inline Corners triangle(Random& random) {
  const Eigen::Vector3d p = point(random), q = point(random);
  return {p, q, point(random)};
}

inline Eigen::Vector3d latticePoint(Random& random, int n) {
  const int x = integer(random, -n, n), y = integer(random, -n, n);
  return Eigen::Vector3d(x, y, integer(random, -n, n));
}

/// Returns six vertices, each made by a call of `vertex`.
template <typename Vertex>
TrianglePair verticesFrom(const Vertex& vertex) {
  return {{vertex(), vertex(), vertex()}, {vertex(), vertex(), vertex()}};
}

/// Returns every vertex of both triangles mapped by f.
template <typename Map>
TrianglePair mapped(TrianglePair pair, const Map& f) {
  for (Eigen::Vector3d& p : pair.a) p = f(p);
  for (Eigen::Vector3d& p : pair.b) p = f(p);
  return pair;
}

inline TrianglePair scaled(const TrianglePair& pair, double factor) {
  return mapped(pair, [factor](const Eigen::Vector3d& p) -> Eigen::Vector3d { return factor * p; });
}

inline TrianglePair shifted(const TrianglePair& pair, const Eigen::Vector3d& t) {
  return mapped(pair, [&t](const Eigen::Vector3d& p) -> Eigen::Vector3d { return p + t; });
}

/// Returns it moved rigidly at random, then rounded, so that nothing is exact that was so in
/// `pair`.
inline TrianglePair posed(Random& random, const TrianglePair& pair) {
  const Eigen::Matrix3d R = rotation(random);
  const Eigen::Vector3d t = point(random);
  // R p + t in the order of Eigen's product on x86, which is fused on some machines.
  return mapped(pair, [&](const Eigen::Vector3d& p) -> Eigen::Vector3d {
    return {R(0, 0) * p[0] + R(0, 1) * p[1] + R(0, 2) * p[2] + t[0],
            R(1, 0) * p[0] + R(1, 1) * p[1] + R(1, 2) * p[2] + t[1],
            R(2, 0) * p[0] + (R(2, 1) * p[1] + R(2, 2) * p[2]) + t[2]};
  });
}

/// Returns a maker of pairs by makers of a triangle each.
template <typename First, typename Second>
auto pairOf(First first, Second second) {
  return [=](Random& random) {
    const Corners a = first(random);
    return TrianglePair{a, second(random)};
  };
}

/// Returns a maker of posed() pairs, scaled before.
template <typename Make>
auto posedBy(double factor, Make make) {
  return [=](Random& random) {
    const TrianglePair pair = make(random);
    return posed(random, scaled(pair, factor));
  };
}

/// Returns random lattice triangles that touch exactly: see touching_triangles.cpp.
TrianglePair latticeVertexOnFace(Random& random);
TrianglePair latticeVertexOnEdge(Random& random);
TrianglePair latticeEdgeThroughEdge(Random& random);

}  // namespace kios::scenes
