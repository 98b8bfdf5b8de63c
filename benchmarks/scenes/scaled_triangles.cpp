// SPDX-FileCopyrightText: 2026 The fcl_kios authors
// SPDX-License-Identifier: BSD-3-Clause

#include <limits>

#include "triangle_families.h"

namespace kios::scenes {
namespace {

// Near, touching and crossing pairs of size 1 to 100; contacts are exact.
TrianglePair anyPair(Random& random) {
  switch (integer(random, 0, 4)) {
    case 0:
      return {triangle(random), triangle(random)};
    case 1:
      return latticeVertexOnFace(random);
    case 2:
      return latticeVertexOnEdge(random);
    case 3:
      return latticeEdgeThroughEdge(random);
    default: {
      TrianglePair pair = {triangle(random), triangle(random)};
      pair.b[0] = pair.a[0];
      return pair;
    }
  }
}

// Rounded: exact contacts are lost unless the factor is a power of two.
auto scale(double factor) {
  return [factor](Random& random) { return scaled(anyPair(random), factor); };
}

// Rounded in the common frame, whose ulp is large.
auto offset(double distance) {
  return [distance](Random& random) {
    const TrianglePair pair = anyPair(random);
    return shifted(pair, distance * direction(random));
  };
}

// b `size` times smaller; sharing a vertex, or near by a few of its own sizes.
auto mixedSizes(double size, bool touching) {
  return [size, touching](Random& random) {
    TrianglePair pair = {triangle(random), triangle(random)};
    // Only near the origin does the smaller one keep its shape.
    const Eigen::Vector3d origin = pair.a[0];
    for (Eigen::Vector3d& p : pair.a) p -= origin;
    for (Eigen::Vector3d& p : pair.b) p *= size;
    if (touching) pair.b[0].setZero();
    return pair;
  };
}

// Every coordinate has a magnitude of its own; some are equal, so that contacts happen.
auto wildExponents(int lower, int upper) {
  return [lower, upper](Random& random) {
    TrianglePair pair = verticesFrom([&] {
      Eigen::Vector3d p = Eigen::Vector3d::Zero();
      for (double& v : p) {
        if (random.unit() < 0.15) continue;
        v = logUniform(random, lower, upper);
        if (random.unit() < 0.5) v = -v;
      }
      return p;
    });
    for (Eigen::Vector3d& p : pair.b) {
      if (random.unit() < 0.2) p = pair.a[integer(random, 0, 2)];
      if (random.unit() < 0.3) p.x() = pair.a[integer(random, 0, 2)].x();
    }
    return pair;
  };
}

constexpr double kLeast = std::numeric_limits<double>::denorm_min();

// Integers in units of the least positive double.
auto denormalLattice(int n) {
  return [n](Random& random) {
    return verticesFrom([&] { return Eigen::Vector3d(kLeast * latticePoint(random, n)); });
  };
}

// Flat triangles of size 1 at heights of a few of the least positive doubles.
TrianglePair denormalHeights(Random& random) {
  const TrianglePair pair = {triangle(random), triangle(random)};
  return mapped(pair, [&random](const Eigen::Vector3d& p) {
    return Eigen::Vector3d(p.x(), p.y(), kLeast * integer(random, -2, 2));
  });
}

TrianglePair denormalPerturbations(Random& random) {
  const TrianglePair pair = anyPair(random);
  return mapped(pair, [&random](Eigen::Vector3d p) {
    for (int c = 0; c < 3; ++c) {
      if (p[c] == 0) p[c] = kLeast * integer(random, -3, 3);
    }
    return p;
  });
}

}  // namespace

std::vector<TriangleClass> scaledTriangles() {
  return {
      {"offset 1e3", offset(1e3)},
      {"offset 1e6", offset(1e6)},
      {"offset 1e9", offset(1e9)},
      {"offset 1e12", offset(1e12)},
      {"scale 1e-4", scale(1e-4)},
      {"scale 1e-10", scale(1e-10)},
      {"scale 1e10", scale(1e10)},
      {"scale 1e-30", scale(1e-30)},
      {"scale 1e-75", scale(1e-75)},
      {"scale 1e75", scale(1e75)},
      {"scale 1e-150", scale(1e-150)},
      {"scale 1e150", scale(1e150)},
      {"scale 2^-500", scale(0x1p-500)},
      {"scale 2^500", scale(0x1p500)},
      {"scale 1e-298", scale(1e-298)},
      {"scale 1e298", scale(1e298)},
      {"scale 2^-990", scale(0x1p-990)},
      {"scale 2^988", scale(0x1p988)},
      {"size ratio 1e-8", mixedSizes(1e-8, false)},
      {"size ratio 1e-8, touching", mixedSizes(1e-8, true)},
      {"size ratio 1e-20", mixedSizes(1e-20, false)},
      {"size ratio 1e-20, touching", mixedSizes(1e-20, true)},
      {"size ratio 1e-100", mixedSizes(1e-100, false)},
      {"size ratio 1e-100, touching", mixedSizes(1e-100, true)},
      {"size ratio 1e-300", mixedSizes(1e-300, false)},
      {"exponents 2^+-20", wildExponents(-20, 20)},
      {"exponents 2^+-100", wildExponents(-100, 100)},
      {"exponents 2^+-300", wildExponents(-300, 300)},
      {"exponents 2^+-990", wildExponents(-990, 990)},
      {"denormal lattice 2", denormalLattice(2)},
      {"denormal lattice 1e6", denormalLattice(1000000)},
      {"denormal heights", denormalHeights},
      {"denormal perturbations", denormalPerturbations},
      {"around the least normal", scale(0x1p-1024)},
  };
}

}  // namespace kios::scenes
