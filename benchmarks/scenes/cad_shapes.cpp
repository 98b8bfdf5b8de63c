// SPDX-FileCopyrightText: 2026 The fcl_kios authors
// SPDX-License-Identifier: BSD-3-Clause

#include "cad_shapes.h"

#include <array>
#include <cmath>
#include <map>
#include <stdexcept>

#include "placement.h"

namespace kios::scenes {
namespace {

using fcl::Vector3d;

using Loop = std::vector<Vector3d>;  // counter-clockwise seen from above

Loop circle(double radius, double z, int segments) {
  Loop loop;
  for (int i = 0; i < segments; ++i) {
    const double angle = 2 * kPi * (i + 0.5) / segments;
    loop.emplace_back(radius * std::cos(angle), radius * std::sin(angle), z);
  }
  return loop;
}

// Rectangle of half sides x, y with rounded corners, as many points at each of its corners.
Loop roundedRectangle(double x, double y, double rounding, double z, int segments) {
  Loop loop;
  const int quarter = segments / 4;
  for (int i = 0; i < segments; ++i) {
    const int corner = i / quarter;
    const double angle = kPi / 2 * (corner + (i % quarter) / (quarter - 1.0));
    const double centre_x = (corner == 0 || corner == 3 ? 1 : -1) * (x - rounding);
    const double centre_y = (corner < 2 ? 1 : -1) * (y - rounding);
    loop.emplace_back(centre_x + rounding * std::cos(angle), centre_y + rounding * std::sin(angle),
                      z);
  }
  return loop;
}

void addVertices(const Loop& loop, Mesh& mesh) {
  mesh.vertices.insert(mesh.vertices.end(), loop.begin(), loop.end());
}

// Quads from one loop of n vertices to a higher or, at the bottom, wider one.
void addBand(std::size_t lower, std::size_t upper, std::size_t n, Mesh& mesh) {
  for (std::size_t i = 0; i < n; ++i) {
    const std::size_t next = (i + 1) % n;
    mesh.triangles.emplace_back(lower + i, lower + next, upper + next);
    mesh.triangles.emplace_back(lower + i, upper + next, upper + i);
  }
}

/// A solid through loops of as many points each, from the lowest up; its ends are fans about points
/// on the axis.
Mesh capped(const std::vector<Loop>& loops, double bottom_z, double top_z) {
  Mesh mesh;
  const std::size_t n = loops[0].size(), bottom = n * loops.size(), top = bottom + 1;
  for (std::size_t i = 0; i < loops.size(); ++i) {
    addVertices(loops[i], mesh);
    if (i > 0) addBand((i - 1) * n, i * n, n, mesh);
  }
  mesh.vertices.emplace_back(0, 0, bottom_z);
  mesh.vertices.emplace_back(0, 0, top_z);
  for (std::size_t i = 0; i < n; ++i) {
    const std::size_t next = (i + 1) % n;
    mesh.triangles.emplace_back(bottom, next, i);
    mesh.triangles.emplace_back(top, bottom - n + i, bottom - n + next);
  }
  return mesh;
}

}  // namespace

Mesh turnedPart(const std::vector<ProfilePoint>& profile, int segments) {
  if (profile.size() < 3 || profile.front().radius != 0 || profile.back().radius != 0) {
    throw std::invalid_argument("turnedPart: a profile begins and ends on the axis");
  }
  std::vector<Loop> loops;
  for (std::size_t i = 1; i + 1 < profile.size(); ++i) {
    loops.push_back(circle(profile[i].radius, profile[i].z, segments));
  }
  return capped(loops, profile.front().z, profile.back().z);
}

Mesh filletedBar(double x, double y, double length, double fillet, int steps) {
  const int segments = 4 * (steps + 1);
  return capped({roundedRectangle(x / 2, y / 2, fillet, 0, segments),
                 roundedRectangle(x / 2, y / 2, fillet, length, segments)},
                0, length);
}

Mesh stripCylinder(int strips, double length, double width) {
  const double radius = width / (2 * std::sin(kPi / strips));
  return turnedPart({{0, 0}, {radius, 0}, {radius, length}, {0, length}}, strips);
}

Mesh flangedCylinder(double radius, double length, int segments) {
  const double rim = 1.35 * radius;
  const double thickness = 0.12 * length;
  const double chamfer = 0.1 * thickness;
  return turnedPart({{0, 0},
                     {rim - chamfer, 0},
                     {rim, chamfer},
                     {rim, thickness},
                     {radius, thickness},
                     {radius, length - thickness},
                     {rim, length - thickness},
                     {rim, length - chamfer},
                     {rim - chamfer, length},
                     {0, length}},
                    segments);
}

Mesh boredBlock(const Vector3d& size, double rounding, double chamfer, double bore_radius,
                int segments) {
  if (segments < 8 || segments % 4 != 0) {
    throw std::invalid_argument("boredBlock: segments are a multiple of 4, and 8 at least");
  }
  const double x = size.x() / 2;
  const double y = size.y() / 2;
  const double z = size.z() / 2;
  const double inner_x = x - chamfer;
  const double inner_y = y - chamfer;
  const Loop loops[] = {circle(bore_radius, -z, segments),
                        roundedRectangle(inner_x, inner_y, rounding, -z, segments),
                        roundedRectangle(x, y, rounding + chamfer, -z + chamfer, segments),
                        roundedRectangle(x, y, rounding + chamfer, z - chamfer, segments),
                        roundedRectangle(inner_x, inner_y, rounding, z, segments),
                        circle(bore_radius, z, segments)};
  const auto n = static_cast<std::size_t>(segments);
  const std::size_t count = std::size(loops);
  Mesh mesh;
  for (const Loop& loop : loops) addVertices(loop, mesh);
  for (std::size_t i = 0; i < count; ++i) addBand(i * n, (i + 1) % count * n, n, mesh);
  return mesh;
}

Mesh moved(const fcl::Transform3d& X, Mesh mesh) {
  for (Vector3d& p : mesh.vertices) p = (X * p).eval();
  return mesh;
}

Mesh merged(const std::vector<Mesh>& parts) {
  Mesh result;
  for (const Mesh& part : parts) {
    const std::size_t first = result.vertices.size();
    addVertices(part.vertices, result);
    for (const fcl::Triangle& t : part.triangles) {
      result.triangles.emplace_back(first + t[0], first + t[1], first + t[2]);
    }
  }
  return result;
}

Mesh welded(const Mesh& mesh) {
  Mesh result;
  std::map<std::array<double, 3>, std::size_t> index_of;
  const auto index = [&](const Vector3d& p) {
    const auto [entry, is_new] =
        index_of.try_emplace({p.x(), p.y(), p.z()}, result.vertices.size());
    if (is_new) result.vertices.push_back(p);
    return entry->second;
  };
  for (const fcl::Triangle& t : mesh.triangles) {
    const std::size_t a = index(mesh.vertices[t[0]]);
    const std::size_t b = index(mesh.vertices[t[1]]);
    const std::size_t c = index(mesh.vertices[t[2]]);
    result.triangles.emplace_back(a, b, c);
  }
  return result;
}

}  // namespace kios::scenes
