// SPDX-FileCopyrightText: 2026 The fcl_kios authors
// SPDX-License-Identifier: BSD-3-Clause
#include "shape_mesh.h"

#include <cmath>

#include <fcl/geometry/shape/box.h>
#include <fcl/geometry/shape/capsule.h>
#include <fcl/geometry/shape/cone.h>
#include <fcl/geometry/shape/convex.h>
#include <fcl/geometry/shape/cylinder.h>
#include <fcl/geometry/shape/ellipsoid.h>
#include <fcl/geometry/shape/halfspace.h>
#include <fcl/geometry/shape/plane.h>
#include <fcl/geometry/shape/sphere.h>
#include "fcl_kios/model.h"

namespace kios::robot_tool {
namespace {

using fcl::Vector3d;

constexpr int kAround = 36, kRings = 9;  // facets of a turn, and from the pole to the equator
constexpr double kPi = 3.14159265358979323846;

template <typename Shape>
const Shape& as(const fcl::CollisionGeometryd& geometry) {
  return static_cast<const Shape&>(geometry);
}

/// Turns a profile of (radius, z) from below about z.
ShapeMesh turned(const std::vector<Eigen::Vector2d>& profile) {
  ShapeMesh mesh;
  for (const Eigen::Vector2d& p : profile) {
    for (int i = 0; i < kAround; ++i) {
      const double angle = 2 * kPi * i / kAround;
      mesh.vertices.emplace_back(p.x() * std::cos(angle), p.x() * std::sin(angle), p.y());
    }
  }
  for (std::uint32_t ring = 0; ring + 1 < profile.size(); ++ring) {
    for (std::uint32_t i = 0; i < kAround; ++i) {
      const std::uint32_t a = ring * kAround + i, b = ring * kAround + (i + 1) % kAround,
                          c = a + kAround, d = b + kAround;
      mesh.corners.insert(mesh.corners.end(), {a, b, d, a, d, c});
    }
  }
  return mesh;
}

/// A ball whose halves are `apart`.
ShapeMesh ball(double radius, double apart) {
  std::vector<Eigen::Vector2d> profile;
  for (const int half : {-1, 1}) {
    for (int i = 0; i <= kRings; ++i) {
      const double angle = 0.5 * kPi * (half < 0 ? i - kRings : i) / kRings;
      profile.emplace_back(radius * std::cos(angle), radius * std::sin(angle) + half * 0.5 * apart);
    }
  }
  return turned(profile);
}

ShapeMesh box(const Vector3d& half) {
  ShapeMesh mesh;
  for (int i = 0; i < 8; ++i) {
    mesh.vertices.emplace_back((i & 1) != 0 ? half.x() : -half.x(),
                               (i & 2) != 0 ? half.y() : -half.y(),
                               (i & 4) != 0 ? half.z() : -half.z());
  }
  mesh.corners = {0, 2, 3, 0, 3, 1, 4, 5, 7, 4, 7, 6, 0, 1, 5, 0, 5, 4,
                  2, 6, 7, 2, 7, 3, 0, 4, 6, 0, 6, 2, 1, 3, 7, 1, 7, 5};
  return mesh;
}

ShapeMesh convex(const fcl::Convexd& shape) {
  ShapeMesh mesh;
  mesh.vertices = shape.getVertices();
  const std::vector<int>& faces = shape.getFaces();  // a number of corners, and these
  for (std::size_t at = 0; at < faces.size(); at += static_cast<std::size_t>(faces[at]) + 1) {
    for (int k = 2; k < faces[at]; ++k) {
      for (const int corner : {1, k, k + 1}) {
        mesh.corners.push_back(
            static_cast<std::uint32_t>(faces[at + static_cast<std::size_t>(corner)]));
      }
    }
  }
  return mesh;
}

ShapeMesh square(const Vector3d& normal, double offset, double extent) {
  ShapeMesh mesh = box({0.5 * extent, 0.5 * extent, 0});
  const Eigen::Quaterniond turn = Eigen::Quaterniond::FromTwoVectors(Vector3d::UnitZ(), normal);
  for (Vector3d& p : mesh.vertices) p = turn * p + offset * normal;
  return mesh;
}

}  // namespace

ShapeMesh meshOf(const fcl::CollisionGeometryd& geometry, double extent) {
  switch (geometry.getNodeType()) {
    case fcl::GEOM_BOX:
      return box(0.5 * as<fcl::Boxd>(geometry).side);
    case fcl::GEOM_SPHERE:
      return ball(as<fcl::Sphered>(geometry).radius, 0);
    case fcl::GEOM_CAPSULE:
      return ball(as<fcl::Capsuled>(geometry).radius, as<fcl::Capsuled>(geometry).lz);
    case fcl::GEOM_ELLIPSOID: {
      ShapeMesh mesh = ball(1, 0);
      for (Vector3d& p : mesh.vertices) p = p.cwiseProduct(as<fcl::Ellipsoidd>(geometry).radii);
      return mesh;
    }
    case fcl::GEOM_CYLINDER: {
      const auto& s = as<fcl::Cylinderd>(geometry);
      const double z = 0.5 * s.lz;
      return turned({{0, -z}, {s.radius, -z}, {s.radius, z}, {0, z}});
    }
    case fcl::GEOM_CONE: {
      const auto& s = as<fcl::Coned>(geometry);
      return turned({{0, -0.5 * s.lz}, {s.radius, -0.5 * s.lz}, {0, 0.5 * s.lz}});
    }
    case fcl::GEOM_CONVEX:
      return convex(as<fcl::Convexd>(geometry));
    case fcl::GEOM_HALFSPACE:
      return square(as<fcl::Halfspaced>(geometry).n, as<fcl::Halfspaced>(geometry).d, extent);
    case fcl::GEOM_PLANE:
      return square(as<fcl::Planed>(geometry).n, as<fcl::Planed>(geometry).d, extent);
    default:
      break;
  }
  ShapeMesh mesh;
  if (geometry.getObjectType() != fcl::OT_BVH) return mesh;
  const auto& model = as<Modeld>(geometry);
  mesh.vertices.assign(model.vertices, model.vertices + model.num_vertices);
  for (int i = 0; i < model.num_tris; ++i) {
    for (int c = 0; c < 3; ++c) {
      mesh.corners.push_back(static_cast<std::uint32_t>(model.tri_indices[i][c]));
    }
  }
  return mesh;
}

}  // namespace kios::robot_tool
