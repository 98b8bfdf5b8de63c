// SPDX-FileCopyrightText: 2026 The fcl_kios authors
// SPDX-License-Identifier: BSD-3-Clause
#include <algorithm>
#include <cstdlib>

#include "input.h"

namespace kios::files {
namespace {

using Point = Eigen::Vector2d;

/// Twice the area of a triangle, positive if it turns left.
double turn(const Point& a, const Point& b, const Point& c) {
  return (b.x() - a.x()) * (c.y() - a.y()) - (b.y() - a.y()) * (c.x() - a.x());
}

/// Whether the triangle at `at` can be cut off a ring: it turns left, no other corner lies in it or
/// on its border, and no edge crosses the cut. Corners at equal places are where a slit to a hole
/// is. A turn of at most `flat` is none.
bool isEar(const std::vector<Point>& p, const std::vector<std::size_t>& ring, std::size_t at,
           double flat) {
  const std::size_t n = ring.size();
  const Point &a = p[ring[(at + n - 1) % n]], &b = p[ring[at]], &c = p[ring[(at + 1) % n]];
  if (!(turn(a, b, c) > flat)) return false;
  for (std::size_t i = 2; i + 1 < n; ++i) {
    const Point &q = p[ring[(at + i) % n]], &next = p[ring[(at + i + 1) % n]];
    const double side = turn(c, a, q);
    if (side >= -flat && q != a && q != b && q != c && turn(a, b, q) >= -flat &&
        turn(b, c, q) >= -flat) {
      return false;
    }
    const double other = turn(c, a, next);
    if (std::max(side, other) > flat && std::min(side, other) < -flat &&
        std::max(turn(q, next, c), turn(q, next, a)) > flat &&
        std::min(turn(q, next, c), turn(q, next, a)) < -flat) {
      return false;
    }
  }
  return true;
}

/// The most corners of a polygon that isn't convex; ears take a time that grows with its square.
constexpr std::size_t kMostCorners = 1 << 15;

/// Appends the triangles of a polygon, two less than it has corners. False if it crosses
/// itself or has no area, so that its triangles aren't its surface.
bool triangulate(const Input& input, const char* place, const std::vector<fcl::Vector3d>& vertices,
                 const std::vector<long long>& polygon, std::vector<fcl::Triangle>& triangles) {
  const std::size_t n = polygon.size();
  const auto corner = [&](std::size_t i) { return static_cast<std::size_t>(polygon[i]); };
  const auto cut = [&](std::size_t i, std::size_t j, std::size_t k) {
    triangles.emplace_back(corner(i), corner(j), corner(k));
  };
  // From the first corner, so that a place far from the origin costs no digits.
  const auto from_first = [&](std::size_t i) -> fcl::Vector3d {
    return vertices[corner(i)] - vertices[corner(0)];
  };
  fcl::Vector3d normal = fcl::Vector3d::Zero();
  for (std::size_t i = 1; i + 1 < n; ++i) normal += from_first(i).cross(from_first(i + 1));
  int axis = 0;
  normal.cwiseAbs().maxCoeff(&axis);
  int x = (axis + 1) % 3, y = (axis + 2) % 3;
  if (normal[axis] < 0) std::swap(x, y);
  std::vector<Point> p(n);
  for (std::size_t i = 0; i < n; ++i) p[i] = Point(from_first(i)[x], from_first(i)[y]);

  bool fan = true;
  for (std::size_t i = 1; i + 1 < n; ++i) fan = fan && turn(p[0], p[i], p[i + 1]) > 0;
  if (fan || normal[axis] == 0) {
    for (std::size_t i = 1; i + 1 < n; ++i) cut(0, i, i + 1);
    return fan;
  }
  if (n > kMostCorners) {
    input.refuse(place, "a polygon of " + std::to_string(n) +
                            " corners that isn't convex; at most " + std::to_string(kMostCorners) +
                            " are read.");
  }
  // Coordinates are rounded to 2^-53 of themselves, so corners on a line turn by as much.
  double far = 0, size = 0;
  for (std::size_t i = 0; i < n; ++i) {
    far = std::max(far, vertices[corner(i)].lpNorm<Eigen::Infinity>());
    size = std::max(size, p[i].norm());
  }
  const double flat = 0x1p-50 * far * size;
  std::vector<std::size_t> ring(n);
  for (std::size_t i = 0; i < n; ++i) ring[i] = i;
  bool simple = true;
  std::size_t at = 0, refused = 0;
  while (ring.size() > 3) {
    const std::size_t m = ring.size();
    if (!isEar(p, ring, at, flat)) {
      at = (at + 1) % m;
      if (++refused <= m) continue;
      simple = false;  // no ear is left: any triangle will do
    }
    cut(ring[(at + m - 1) % m], ring[at], ring[(at + 1) % m]);
    ring.erase(ring.begin() + static_cast<std::ptrdiff_t>(at));
    at = (at + 1) % (m - 1);  // not the next corner: that would make a fan of slivers
    refused = 0;
  }
  cut(ring[0], ring[1], ring[2]);
  return simple && turn(p[ring[0]], p[ring[1]], p[ring[2]]) > -flat;
}

}  // namespace

int Faces::beginObject(const std::string& name) {
  // What came before the first has no name.
  if (objects_.empty() && !faces_.empty()) objects_.emplace_back();
  objects_.push_back(name);
  return object_ = static_cast<int>(objects_.size()) - 1;
}

void Faces::finish(Mesh& mesh) {
  std::vector<long long> polygon;
  std::string crossing;
  std::size_t crossings = 0;
  mesh.triangles.reserve(mesh.triangles.size() + faces_.size());
  const auto vertices = static_cast<long long>(mesh.vertices.size());
  int object = 0;
  for (std::size_t i = 0; i < faces_.size(); ++i) {
    mesh.object_of.resize(objects_.empty() ? 0 : mesh.triangles.size(), object);
    const std::size_t begin = faces_[i].first;
    const char* const at = faces_[i].at;
    object = std::max(faces_[i].object, 0);
    const std::size_t end = i + 1 < faces_.size() ? faces_[i + 1].first : corners_.size();
    for (std::size_t c = begin; c < end; ++c) {
      if (0 <= corners_[c] && corners_[c] < vertices) continue;
      input_.refuse(at, "face " + std::to_string(i) + " refers to vertex " +
                            std::to_string(corners_[c] + base_) + ", but there are " +
                            std::to_string(vertices) + ".");
    }
    if (end - begin == 3) {
      const auto corner = [&](std::size_t k) {
        return static_cast<std::size_t>(corners_[begin + k]);
      };
      mesh.triangles.emplace_back(corner(0), corner(1), corner(2));
      continue;
    }
    polygon.assign(corners_.begin() + static_cast<std::ptrdiff_t>(begin),
                   corners_.begin() + static_cast<std::ptrdiff_t>(end));
    polygon.erase(std::unique(polygon.begin(), polygon.end()), polygon.end());
    while (polygon.size() > 1 && polygon.front() == polygon.back()) polygon.pop_back();
    if (polygon.size() < 3) {
      ++mesh.other_faces;
    } else if (!triangulate(input_, at, mesh.vertices, polygon, mesh.triangles) &&
               ++crossings == 1) {
      crossing = input_.sentence(at, "face " + std::to_string(i));
    }
  }
  mesh.object_of.resize(objects_.empty() ? 0 : mesh.triangles.size(), object);
  mesh.objects = objects_;
  if (mesh.other_faces > 0) {
    mesh.warnings.push_back(input_.sentence(
        nullptr, counted(mesh.other_faces, "point or line", "points or lines") + " left out."));
  }
  if (crossings > 0) {
    mesh.warnings.push_back(crossing + " crosses itself or has no area, the first of " +
                            std::to_string(crossings) + ": its triangles may be wrong.");
  }
  if (mesh.triangles.empty()) {
    input_.refuse(nullptr,
                  "it holds no triangles (" + counted(mesh.vertices.size(), "vertex", "vertices") +
                      ", " + counted(mesh.other_faces, "point or line", "points or lines") + ").");
  }
}

}  // namespace kios::files
