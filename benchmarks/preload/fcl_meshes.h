// SPDX-FileCopyrightText: 2026 The fcl_kios authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cmath>
#include <memory>
#include <random>
#include <vector>

#include <fcl/fcl.h>

// Meshes and poses for programs that know FCL alone.

struct Soup {
  std::vector<fcl::Vector3d> vertices;
  std::vector<fcl::Triangle> triangles;
};

/// Returns a torus about z of so many squares, radii `size` and about 0.4 of it, with bumps.
inline Soup torus(int around, int across, double size = 1) {
  const double pi = std::acos(-1);
  Soup soup;
  for (int i = 0; i < around; ++i) {
    for (int j = 0; j < across; ++j) {
      const double u = 2 * pi * i / around, v = 2 * pi * j / across;
      const double r = 0.4 + 0.05 * std::sin(5 * u + 1) * std::cos(3 * v);
      soup.vertices.emplace_back(size * (1 + r * std::cos(v)) * std::cos(u),
                                 size * (1 + r * std::cos(v)) * std::sin(u),
                                 size * r * std::sin(v));
      const auto at = [&](int k, int l) {
        return static_cast<std::size_t>((k % around) * across + l % across);
      };
      soup.triangles.emplace_back(at(i, j), at(i + 1, j), at(i + 1, j + 1));
      soup.triangles.emplace_back(at(i, j), at(i + 1, j + 1), at(i, j + 1));
    }
  }
  return soup;
}

template <typename BV>
void fill(fcl::BVHModel<BV>& model, const Soup& soup) {
  model.beginModel(static_cast<int>(soup.triangles.size()), static_cast<int>(soup.vertices.size()));
  model.addSubModel(soup.vertices, soup.triangles);
  model.endModel();
  model.computeLocalAABB();
}

template <typename BV>
std::shared_ptr<fcl::BVHModel<BV>> build(const Soup& soup) {
  auto model = std::make_shared<fcl::BVHModel<BV>>();
  fill(*model, soup);
  return model;
}

inline fcl::Transform3d randomPose(std::mt19937& random, double nearest, double farthest) {
  std::normal_distribution<double> normal;
  std::uniform_real_distribution<double> distance(nearest, farthest);
  const Eigen::Quaterniond q(normal(random), normal(random), normal(random), normal(random));
  fcl::Transform3d pose = fcl::Transform3d::Identity();
  pose.linear() = q.normalized().toRotationMatrix();
  const fcl::Vector3d direction(normal(random), normal(random), normal(random));
  pose.translation() = distance(random) * direction.normalized();
  return pose;
}

inline double distanceOf(const fcl::CollisionGeometryd& a, const fcl::CollisionGeometryd& b,
                         const fcl::Transform3d& X_WB) {
  fcl::DistanceResultd result;
  fcl::distance(&a, fcl::Transform3d::Identity(), &b, X_WB, fcl::DistanceRequestd(true), result);
  return result.min_distance;
}
