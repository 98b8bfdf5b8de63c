// SPDX-FileCopyrightText: 2026 The fcl_kios authors
// SPDX-License-Identifier: BSD-3-Clause

#include "triangle_families.h"

namespace kios::scenes {
namespace {

// Edges that are nearest to one another, at an angle (rad) and any gap; the rest points away.
auto nearParallelEdges(double angle) {
  return [angle](Random& random) {
    const double gap = logUniform(random, -34, -1);
    const double slide = random.uniform(-0.5, 0.5), slope = angle * randomSign(random);
    const Eigen::Vector3d a(0.5 * random.unit() + 0.5, 0, 0);
    const Eigen::Vector3d along(1, slope, 0), middle(slide, 0, gap);
    const Corners below = {a, -a, {random.uniform(-1, 1), random.uniform(-1, 1), -1}};
    const Corners above = {middle + random.uniform(0.1, 1) * along,
                           middle - random.uniform(0.1, 1) * along,
                           {random.uniform(-1, 1), random.uniform(-1, 1), 2}};
    return posed(random, {below, above});
  };
}

// Two such edges beside one another, the third vertices anywhere: other features may be nearest.
auto nearParallelAnywhere(double angle) {
  return [angle](Random& random) {
    const Eigen::Vector3d p = point(random), along = point(random);
    const Eigen::Vector3d across = along.cross(direction(random));
    const Eigen::Vector3d beside = p + random.uniform(-0.5, 0.5) * along;
    const Eigen::Vector3d q = beside + displacement(random, -10, 0);
    const Corners a = {p, p + along, p + 0.7 * point(random)};
    const Eigen::Vector3d edge = random.uniform(0.3, 1) * along + angle * across;
    return TrianglePair{a, {q, q + edge, q + 0.7 * point(random)}};
  };
}

// Triangles over one another, the upper one tilted by an angle (rad).
auto nearParallelFaces(double angle) {
  return [angle](Random& random) {
    const double gap = logUniform(random, -34, -1);
    const Eigen::Vector3d tilt = angle * point(random);
    TrianglePair pair = {triangle(random), triangle(random)};
    for (Eigen::Vector3d& p : pair.a) p.z() = 0;
    for (Eigen::Vector3d& p : pair.b) p.z() = gap + tilt.x() * p.x() + tilt.y() * p.y();
    return posed(random, pair);
  };
}

enum class Sliver { kNeedle, kCap };  // the short height at an end of the long edge, or inside it

Corners sliver(Random& random, double aspect, Sliver shape) {
  const Eigen::Vector3d p = point(random), along = direction(random);
  const Eigen::Vector3d across = along.cross(direction(random)).normalized();
  const double foot = shape == Sliver::kNeedle ? 0 : random.uniform(0.1, 0.9);
  return {p, p + along, p + foot * along + across / aspect};
}

auto sliverPair(double aspect, Sliver shape) {
  const auto one = [=](Random& random) { return sliver(random, aspect, shape); };
  return pairOf(one, one);
}

// A sliver of any width in the plane z = 0, and above it a vertex, or all three in one point, whose
// foot lies at `along` on the long edge's line and a few widths beside it.
TrianglePair besideSliver(Random& random, const Eigen::Vector3d& edge, double along) {
  const Eigen::Vector3d across(-edge.y(), edge.x(), 0);
  const double width = logUniform(random, -90, -1);
  const int apex = integer(random, 0, 2);  // over either end of the long edge, or between them
  const double foot = apex < 2 ? apex : random.unit();
  const Corners sliver = {Eigen::Vector3d(0, 0, 0), edge, foot * edge + width * across};
  const double beside = random.unit() < 0.3 ? 0 : random.uniform(-1, 2) * width;
  const double height = logUniform(random, -40, 0);
  const Eigen::Vector3d vertex = along * edge + beside * across + Eigen::Vector3d(0, 0, height);
  Corners above = triangle(random);
  const bool one_point = random.unit() < 0.5;
  for (Eigen::Vector3d& p : above)
    p = one_point ? vertex : Eigen::Vector3d(p.x(), p.y(), p.z() + 2);
  above[0] = vertex;
  return {sliver, above};
}

TrianglePair overSliver(Random& random) {
  const Eigen::Vector3d d = direction(random);
  return besideSliver(random, {d.x(), d.y(), 0}, random.unit());
}

TrianglePair beyondSliver(Random& random) {
  const Eigen::Vector3d d = direction(random);
  return besideSliver(random, {d.x(), d.y(), 0}, random.uniform(-2, 3));
}

// Places feet exactly on the line.
TrianglePair beyondLatticeSliver(Random& random) {
  const double x = integer(random, 1, 4), y = integer(random, -4, 4);
  return besideSliver(random, {x, y, 0}, integer(random, -12, 16) / 4.0);
}

// A vertex over a face, at height `gap`; below it if negative.
TrianglePair vertexOverFace(Random& random, double gap) {
  const double x = random.uniform(0.2, 1), y = random.uniform(0.2, 1);
  const Corners face = {
      Eigen::Vector3d(x, random.uniform(-0.2, 0.2), 0), {-x, y, 0}, {random.uniform(-1, 0), -y, 0}};
  Corners above = triangle(random);
  for (Eigen::Vector3d& p : above) p.z() = random.uniform(0.1, 1);
  above[0] = {0, 0, gap};
  return {face, above};
}

TrianglePair edgeOverEdge(Random& random, double gap) {
  const double turn = random.uniform(-1, 1);
  const Corners below = {Eigen::Vector3d(random.uniform(0.1, 1), 0, 0),
                         {-random.uniform(0.1, 1), 0, 0},
                         {random.uniform(-1, 1), random.uniform(-1, 1), -1}};
  const double r = random.uniform(0.1, 1), s = random.uniform(0.1, 1);
  const Corners above = {Eigen::Vector3d(r * turn, r, gap),
                         {-s * turn, -s, gap},
                         {random.uniform(-1, 1), random.uniform(-1, 1), 1}};
  return {below, above};
}

TrianglePair faceOverFace(Random& random, double gap) {
  TrianglePair pair = vertexOverFace(random, gap);
  for (Eigen::Vector3d& p : pair.b) p.z() = gap;
  return pair;
}

// 1e-16 to 1e-3.
double smallGap(Random& random) { return logUniform(random, -53, -10); }

using Over = TrianglePair (*)(Random&, double);

// Gap (sign = 1) or penetration (-1): exact along z, or posed at random and rounded.
auto smallGapOf(Over over, double sign, bool exact) {
  return [=](Random& random) {
    const TrianglePair pair = over(random, sign * smallGap(random));
    return exact ? pair : posed(random, pair);
  };
}

}  // namespace

std::vector<TriangleClass> separatedTriangles() {
  return {
      {"random", pairOf(triangle, triangle)},
      {"random near",
       [](Random& r) {
         TrianglePair pair = {triangle(r), triangle(r)};
         for (Eigen::Vector3d& p : pair.b) p.x() += 2;
         return posed(r, pair);
       }},
      {"random apart",
       [](Random& r) {
         TrianglePair pair = {triangle(r), triangle(r)};
         const Eigen::Vector3d t = 10 * direction(r);
         for (Eigen::Vector3d& p : pair.b) p += t;
         return pair;
       }},
      {"random far apart",
       [](Random& r) {
         TrianglePair pair = {triangle(r), triangle(r)};
         const Eigen::Vector3d t = displacement(r, 10, 30);
         for (Eigen::Vector3d& p : pair.b) p += t;
         return pair;
       }},
      {"interpenetrating",
       [](Random& r) { return posed(r, vertexOverFace(r, -r.uniform(0.1, 1))); }},
      {"small near large",
       [](Random& r) {
         TrianglePair pair = {triangle(r), triangle(r)};
         const Eigen::Vector3d t = pair.a[0];
         const double size = logUniform(r, -20, -4);
         for (Eigen::Vector3d& p : pair.b) p = t + size * p;
         return pair;
       }},
      {"edges at 1e-1 rad", nearParallelEdges(1e-1)},
      {"edges at 1e-2 rad", nearParallelEdges(1e-2)},
      {"edges at 1e-3 rad", nearParallelEdges(1e-3)},
      {"edges at 1e-4 rad", nearParallelEdges(1e-4)},
      {"edges at 1e-5 rad", nearParallelEdges(1e-5)},
      {"edges at 1e-6 rad", nearParallelEdges(1e-6)},
      {"edges at 1e-7 rad", nearParallelEdges(1e-7)},
      {"edges at 1e-8 rad", nearParallelEdges(1e-8)},
      {"edges at 1e-9 rad", nearParallelEdges(1e-9)},
      {"edges at 1e-11 rad", nearParallelEdges(1e-11)},
      {"edges at 1e-13 rad", nearParallelEdges(1e-13)},
      {"edges at 1e-15 rad", nearParallelEdges(1e-15)},
      {"edges at 1e-17 rad", nearParallelEdges(1e-17)},
      {"parallel edges", nearParallelEdges(0)},
      {"edges at 1e-4 rad, anywhere", nearParallelAnywhere(1e-4)},
      {"edges at 1e-8 rad, anywhere", nearParallelAnywhere(1e-8)},
      {"edges at 1e-12 rad, anywhere", nearParallelAnywhere(1e-12)},
      {"edges at 1e-16 rad, anywhere", nearParallelAnywhere(1e-16)},
      {"faces at 1e-3 rad", nearParallelFaces(1e-3)},
      {"faces at 1e-8 rad", nearParallelFaces(1e-8)},
      {"faces at 1e-15 rad", nearParallelFaces(1e-15)},
      {"needles 1e3", sliverPair(1e3, Sliver::kNeedle)},
      {"needles 1e6", sliverPair(1e6, Sliver::kNeedle)},
      {"needles 1e9", sliverPair(1e9, Sliver::kNeedle)},
      {"needles 1e12", sliverPair(1e12, Sliver::kNeedle)},
      {"caps 1e3", sliverPair(1e3, Sliver::kCap)},
      {"caps 1e6", sliverPair(1e6, Sliver::kCap)},
      {"caps 1e9", sliverPair(1e9, Sliver::kCap)},
      {"caps 1e12", sliverPair(1e12, Sliver::kCap)},
      {"cap and triangle",
       [](Random& r) {
         const Corners a = sliver(r, logUniform(r, 10, 40), Sliver::kCap);
         return TrianglePair{a, triangle(r)};
       }},
      {"over a sliver", overSliver},
      {"over a sliver, posed", posedBy(1, overSliver)},
      {"beyond a sliver", beyondSliver},
      {"beyond a sliver, posed", posedBy(1, beyondSliver)},
      {"beyond a sliver, lattice", beyondLatticeSliver},
      {"gap vertex-face", smallGapOf(vertexOverFace, 1, false)},
      {"gap edge-edge", smallGapOf(edgeOverEdge, 1, false)},
      {"gap face-face", smallGapOf(faceOverFace, 1, false)},
      {"gap vertex-face along z", smallGapOf(vertexOverFace, 1, true)},
      {"gap edge-edge along z", smallGapOf(edgeOverEdge, 1, true)},
      {"gap face-face along z", smallGapOf(faceOverFace, 1, true)},
      {"penetration vertex-face", smallGapOf(vertexOverFace, -1, false)},
      {"penetration edge-edge", smallGapOf(edgeOverEdge, -1, false)},
      {"penetration vertex-face z", smallGapOf(vertexOverFace, -1, true)},
      {"penetration edge-edge z", smallGapOf(edgeOverEdge, -1, true)},
  };
}

}  // namespace kios::scenes
