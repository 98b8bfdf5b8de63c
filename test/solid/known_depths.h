// SPDX-FileCopyrightText: 2026 The fcl_kios authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <algorithm>
#include <limits>
#include <vector>

#include <Eigen/Geometry>
#include "shapes.h"

// Depths that are known, by formulas that share nothing with the library's search.

namespace kios::testing {

/// Returns max n x over a mesh's vertices at a pose.
inline double extentAlong(const Mesh& mesh, const fcl::Transform3d& X, const fcl::Vector3d& n) {
  double most = -std::numeric_limits<double>::infinity();
  for (const fcl::Vector3d& p : mesh.vertices) most = std::max(most, n.dot(X * p));
  return most;
}

/// Returns distinct directions of a mesh's faces or edges at a pose.
inline std::vector<fcl::Vector3d> directionsOf(const Mesh& mesh, const fcl::Transform3d& X,
                                               bool faces) {
  std::vector<fcl::Vector3d> directions;
  const auto add = [&](const fcl::Vector3d& v) {
    const fcl::Vector3d n = (X.linear() * v).normalized();
    for (const fcl::Vector3d& other : directions) {
      if (other.dot(n) > 1 - 1e-14 || (!faces && other.dot(n) < -1 + 1e-14)) return;
    }
    directions.push_back(n);
  };
  for (const fcl::Triangle& t : mesh.triangles) {
    const fcl::Vector3d &a = mesh.vertices[t[0]], &b = mesh.vertices[t[1]],
                        &c = mesh.vertices[t[2]];
    if (faces) {
      add((b - a).cross(c - a));
    } else {
      add(b - a);
      add(c - b);
      add(a - c);
    }
  }
  return directions;
}

/// Returns the depth of two convex meshes, 0 if they are apart: the least extent of the set of
/// differences along the normal of one of its faces, which is that of a face of either, or crosses
/// an edge of each.
inline double convexDepth(const Mesh& a, const fcl::Transform3d& X_WA, const Mesh& b,
                          const fcl::Transform3d& X_WB) {
  double depth = std::numeric_limits<double>::infinity();
  const auto along = [&](const fcl::Vector3d& n) {
    depth = std::min(depth, extentAlong(a, X_WA, n) + extentAlong(b, X_WB, -n));
  };
  for (const fcl::Vector3d& n : directionsOf(a, X_WA, true)) along(n);
  for (const fcl::Vector3d& n : directionsOf(b, X_WB, true)) along(-n);
  const auto edges_b = directionsOf(b, X_WB, false);
  for (const fcl::Vector3d& e : directionsOf(a, X_WA, false)) {
    for (const fcl::Vector3d& f : edges_b) {
      const fcl::Vector3d n = e.cross(f);
      if (!(n.norm() > 1e-9)) continue;
      along(n.normalized());
      along(-n.normalized());
    }
  }
  return std::max(0.0, depth);
}

/// Holds axis-aligned boxes, whose union is a solid.
using Boxes = std::vector<Eigen::AlignedBox3d>;

/// Returns the depth of two unions of boxes: the point nearest to the origin outside the union of
/// the open boxes of differences. Its coordinates are 0 or those of faces.
inline double depthOfUnions(const Boxes& a, const Boxes& b) {
  Boxes differences;
  for (const auto& p : a) {
    for (const auto& q : b) differences.emplace_back(p.min() - q.max(), p.max() - q.min());
  }
  std::vector<double> at[3];
  for (int c = 0; c < 3; ++c) {
    at[c].push_back(0);
    for (const auto& d : differences) {
      at[c].push_back(d.min()[c]);
      at[c].push_back(d.max()[c]);
    }
  }
  double least = std::numeric_limits<double>::infinity();
  for (const double x : at[0]) {
    for (const double y : at[1]) {
      for (const double z : at[2]) {
        const fcl::Vector3d t(x, y, z);
        if (!(t.norm() < least)) continue;
        const bool within = std::any_of(differences.begin(), differences.end(), [&](const auto& d) {
          return (t.array() > d.min().array()).all() && (t.array() < d.max().array()).all();
        });
        if (!within) least = t.norm();
      }
    }
  }
  return least;
}

inline Mesh meshOf(const Boxes& boxes) {
  std::vector<Mesh> parts;
  for (const auto& box : boxes) {
    parts.push_back(transformed(scenes::subdividedBox(box.sizes(), 1), 1, box.center()));
  }
  return scenes::merged(parts);
}

}  // namespace kios::testing
