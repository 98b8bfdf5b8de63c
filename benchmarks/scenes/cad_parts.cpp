// SPDX-FileCopyrightText: 2026 The fcl_kios authors
// SPDX-License-Identifier: BSD-3-Clause
#include "cad_parts.h"

#include <algorithm>
#include <cmath>
#include <stdexcept>

#include "cad_shapes.h"
#include "placement.h"

namespace kios::scenes {
namespace {

using fcl::Vector3d;

/// Holds a closed polygon about the z axis, counter-clockwise seen from above.
struct Corner {
  double x, y;
};
using Outline = std::vector<Corner>;

Outline circle(double radius, int segments, double start = 0) {
  Outline outline;
  for (int i = 0; i < segments; ++i) {
    const double angle = start + 2 * kPi * i / segments;
    outline.push_back({radius * std::cos(angle), radius * std::sin(angle)});
  }
  return outline;
}

/// Holds the indices of a closed polygon's vertices.
using Loop = std::vector<std::size_t>;

Loop addOutline(const Outline& outline, double z, Mesh& mesh,
                const Vector3d& centre = Vector3d::Zero()) {
  Loop loop;
  for (const Corner& p : outline) {
    loop.push_back(mesh.vertices.size());
    mesh.vertices.push_back(centre + Vector3d(p.x, p.y, z));
  }
  return loop;
}

/// A triangle that faces outwards if it faces up, or else the other way round.
void addTriangle(std::size_t a, std::size_t b, std::size_t c, bool up, Mesh& mesh) {
  if (up) {
    mesh.triangles.emplace_back(a, b, c);
  } else {
    mesh.triangles.emplace_back(a, c, b);
  }
}

/// The wall between a loop and the one above it, seen from outside of it, or from inside.
void addWall(const Loop& lower, const Loop& upper, bool outside, Mesh& mesh) {
  for (std::size_t i = 0; i < lower.size(); ++i) {
    const std::size_t next = (i + 1) % lower.size();
    addTriangle(lower[i], lower[next], upper[next], outside, mesh);
    addTriangle(lower[i], upper[next], upper[i], outside, mesh);
  }
}

/// The ring between two flat loops about a point, which begin in one direction from it: fans that
/// advance along whichever lies behind.
void addRing(const Loop& inner, const Loop& outer, const Vector3d& centre, bool up, Mesh& mesh) {
  const auto turned = [&](const Loop& loop, std::size_t i) {  // from the first of the loop
    if (i == loop.size()) return 2 * kPi;
    const Vector3d p = mesh.vertices[loop[i]] - centre, first = mesh.vertices[loop[0]] - centre;
    const double angle =
        std::atan2(first.x() * p.y() - first.y() * p.x(), first.x() * p.x() + first.y() * p.y());
    return i > 0 && angle <= 0 ? angle + 2 * kPi : angle;
  };
  const auto at = [](const Loop& loop, std::size_t i) { return loop[i % loop.size()]; };
  std::size_t i = 0, o = 0;
  while (i < inner.size() || o < outer.size()) {
    const bool along_inner =
        o == outer.size() || (i < inner.size() && turned(inner, i + 1) <= turned(outer, o + 1));
    if (along_inner) {
      addTriangle(at(inner, i), at(outer, o), at(inner, i + 1), up, mesh);
      ++i;
    } else {
      addTriangle(at(inner, i), at(outer, o), at(outer, o + 1), up, mesh);
      ++o;
    }
  }
}

/// From z = 0 to `length`, between two outlines that begin in one direction.
Mesh extrudedRing(const Outline& inner, const Outline& outer, double length) {
  Mesh mesh;
  const Loop in[2] = {addOutline(inner, 0, mesh), addOutline(inner, length, mesh)};
  const Loop out[2] = {addOutline(outer, 0, mesh), addOutline(outer, length, mesh)};
  addWall(in[0], in[1], false, mesh);
  addWall(out[0], out[1], true, mesh);
  for (const int end : {0, 1}) addRing(in[end], out[end], Vector3d::Zero(), end == 1, mesh);
  return mesh;
}

/// A fan of a flat, convex end about its middle.
void addEnd(const Loop& loop, double z, bool up, Mesh& mesh) {
  const std::size_t middle = mesh.vertices.size();
  mesh.vertices.emplace_back(0, 0, z);
  for (std::size_t i = 0; i < loop.size(); ++i) {
    addTriangle(middle, loop[i], loop[(i + 1) % loop.size()], up, mesh);
  }
}

}  // namespace

Mesh tube(double inner_radius, double outer_radius, double length, int segments) {
  return extrudedRing(circle(inner_radius, segments), circle(outer_radius, segments), length);
}

Mesh spurGear(int teeth, double module, double thickness, double bore_radius, int segments) {
  const double pitch = 0.5 * teeth * module, tip = pitch + module, root = pitch - 1.25 * module;
  if (!(bore_radius < root)) throw std::invalid_argument("spurGear: the bore cuts the teeth");
  Outline outline;
  for (int i = 0; i < teeth; ++i) {  // tip, flank, root, flank of a tooth, by share of its angle
    constexpr double kAt[] = {-0.1, 0.1, 0.35, 0.65};
    for (int k = 0; k < 4; ++k) {
      const double angle = 2 * kPi * (i + 0.1 + kAt[k]) / teeth, radius = k < 2 ? tip : root;
      outline.push_back({radius * std::cos(angle), radius * std::sin(angle)});
    }
  }
  return extrudedRing(circle(bore_radius, segments), outline, thickness);
}

Mesh drilledPlate(int columns, int rows, double pitch, double hole_radius, double thickness,
                  int segments) {
  if (segments % 4 != 0 || !(hole_radius < 0.5 * pitch)) {
    throw std::invalid_argument(
        "drilledPlate: segments are a multiple of 4, and holes smaller than their squares");
  }
  const auto grid = [columns](int i, int j, int level) {
    return 2 * (static_cast<std::size_t>(j) * (columns + 1) + i) + level;
  };
  Mesh mesh;
  for (int j = 0; j <= rows; ++j) {
    for (int i = 0; i <= columns; ++i) {
      for (const double z : {0.0, thickness}) mesh.vertices.emplace_back(i * pitch, j * pitch, z);
    }
  }
  const Outline hole = circle(hole_radius, segments, kPi / 4);
  for (int j = 0; j < rows; ++j) {
    for (int i = 0; i < columns; ++i) {
      const Vector3d centre((i + 0.5) * pitch, (j + 0.5) * pitch, 0);
      Loop loops[2];
      for (const int level : {0, 1}) {
        loops[level] = addOutline(hole, level * thickness, mesh, centre);
        const Loop square = {grid(i + 1, j + 1, level), grid(i, j + 1, level), grid(i, j, level),
                             grid(i + 1, j, level)};
        addRing(loops[level], square, centre, level == 1, mesh);
      }
      addWall(loops[0], loops[1], false, mesh);
    }
  }
  const auto addSide = [&](int i0, int j0, int i1, int j1) {
    addTriangle(grid(i0, j0, 0), grid(i1, j1, 0), grid(i1, j1, 1), true, mesh);
    addTriangle(grid(i0, j0, 0), grid(i1, j1, 1), grid(i0, j0, 1), true, mesh);
  };
  for (int i = 0; i < columns; ++i) {
    addSide(i, 0, i + 1, 0);
    addSide(i + 1, rows, i, rows);
  }
  for (int j = 0; j < rows; ++j) {
    addSide(columns, j, columns, j + 1);
    addSide(0, j + 1, 0, j);
  }
  return mesh;
}

Mesh screw(double radius, double pitch, int turns, int segments) {
  constexpr int kRingsOfTurn = 4;
  const double core = 0.85 * radius, head = 0.7 * radius, length = turns * pitch;
  Mesh mesh;
  // The head, a ring around the thread's foot.
  const Outline hexagon = circle(1.8 * radius, 6), foot = circle(core, segments);
  const Loop bottom = addOutline(hexagon, -head, mesh), top = addOutline(hexagon, 0, mesh);
  addEnd(bottom, -head, false, mesh);
  addWall(bottom, top, true, mesh);
  Loop below = addOutline(foot, 0, mesh);
  addRing(below, top, Vector3d::Zero(), true, mesh);
  // Rings whose radius follows the thread; it runs out at both ends.
  const int rings = kRingsOfTurn * turns;
  for (int ring = 1; ring <= rings; ++ring) {
    const double z = length * ring / rings;
    const double run_out = std::min({1.0, z / pitch, (length - z) / pitch});
    Outline outline;
    for (int i = 0; i < segments; ++i) {
      const double turn = z / pitch - static_cast<double>(i) / segments,
                   share = turn - std::floor(turn);
      const double r = core + run_out * (radius - core) * (1 - std::abs(2 * share - 1));
      const double angle = 2 * kPi * i / segments;
      outline.push_back({r * std::cos(angle), r * std::sin(angle)});
    }
    const Loop above = addOutline(outline, z, mesh);
    addWall(below, above, true, mesh);
    below = above;
  }
  addEnd(below, length, true, mesh);
  return mesh;
}

std::vector<Mesh> cadParts() {
  return {tube(0.03, 0.035, 0.3, 120),
          spurGear(40, 0.004, 0.02, 0.03, 64),
          filletedBar(0.05, 0.03, 0.3, 0.006, 60),
          drilledPlate(5, 3, 0.05, 0.018, 0.004, 32),
          screw(0.012, 0.003, 12, 40),
          boredBlock({0.2, 0.1, 0.05}, 0.01, 0.003, 0.03, 128)};
}

}  // namespace kios::scenes
