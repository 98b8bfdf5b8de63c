// SPDX-FileCopyrightText: 2026 The fcl_kios authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <map>
#include <tuple>
#include <utility>
#include <vector>

#include "fcl_kios/bv/kios.h"
#include "fcl_kios/triangle/distance.h"

namespace kios::inspect {

/// A volume's surface as anyone may have made it. Vertices are told apart by coordinates.
struct Polyhedron {
  std::vector<fcl::Vector3d> vertices;
  std::vector<std::array<std::uint32_t, 3>> triangles;
};

/// Each directed edge has its opposite, once: a closed surface. Triangles whose corners rounding
/// has made one are left out.
inline void expectClosed(const Polyhedron& surface) {
  using Point = std::tuple<double, double, double>;
  std::map<std::pair<Point, Point>, int> edges;
  const auto point = [&](std::uint32_t i) {
    const fcl::Vector3d& v = surface.vertices[i];
    return Point(v[0], v[1], v[2]);
  };
  for (const auto& t : surface.triangles) {
    const Point p[3] = {point(t[0]), point(t[1]), point(t[2])};
    if (p[0] == p[1] || p[1] == p[2] || p[2] == p[0]) continue;
    for (int i = 0; i < 3; ++i) {
      ++edges[{p[i], p[(i + 1) % 3]}];
      --edges[{p[(i + 1) % 3], p[i]}];
    }
  }
  ASSERT_FALSE(edges.empty());
  EXPECT_EQ(std::count_if(edges.begin(), edges.end(), [](const auto& e) { return e.second != 0; }),
            0);
}

/// How far a vertex reaches out of a sphere of the volume, at most.
inline double worstExcess(const Polyhedron& surface, const kIOSd& volume) {
  double worst = -HUGE_VAL;
  for (const fcl::Vector3d& v : surface.vertices) {
    for (int i = 0; i < volume.k(); ++i) {
      worst = std::max(worst, (v - volume.sphereCenter(i)).norm() - volume.sphereRadius(i));
    }
  }
  return worst;
}

/// Whether the surface, wound outwards, goes around p: its solid angle is a full one (van Oosterom
/// and Strackee, "The solid angle of a plane triangle", 1983).
inline bool encloses(const Polyhedron& surface, const fcl::Vector3d& p) {
  double angle = 0;
  for (const auto& t : surface.triangles) {
    const fcl::Vector3d a = (surface.vertices[t[0]] - p).normalized(),
                        b = (surface.vertices[t[1]] - p).normalized(),
                        c = (surface.vertices[t[2]] - p).normalized();
    angle += 2 * std::atan2(a.dot(b.cross(c)), 1 + a.dot(b) + b.dot(c) + c.dot(a));
  }
  return angle > 2 * M_PI;
}

/// How far the farthest point of `content` is outside of the surface; 0 if none is.
inline double worstUncovered(const Polyhedron& surface, const std::vector<fcl::Vector3d>& content) {
  double worst = 0;
  for (const fcl::Vector3d& p : content) {
    if (encloses(surface, p)) continue;
    double nearest = HUGE_VAL;
    for (const auto& [a, b, c] : surface.triangles) {
      const auto& v = surface.vertices;
      nearest = std::min(nearest, triangleDistance<double>({v[a], v[b], v[c]}, {p, p, p}).distance);
    }
    worst = std::max(worst, nearest);
  }
  return worst;
}

}  // namespace kios::inspect
