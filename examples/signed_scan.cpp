// SPDX-FileCopyrightText: 2026 The fcl_kios authors
// SPDX-License-Identifier: BSD-3-Clause
//
// A scan is no solid: triangles are missing, and those that are there share no vertices and are off
// by noise. Its winding number tells what is inside all the same. The scan is made here: a box of
// 1 m, of which a twentieth is missing; so the answers can be checked.
//
// usage: signed_scan

#include <fcl_kios/fcl_kios.h>

#include <cmath>
#include <cstdio>
#include <random>
#include <vector>

#include "shapes.h"

int main() {
  shapes::Mesh<double> box;
  shapes::addBox<double>(box, {1, 1, 1}, {0, 0, 0}, 40);
  std::mt19937 random(1);
  std::uniform_real_distribution<double> unit(0, 1), noise(-0.0005, 0.0005);
  shapes::Mesh<double> scan;
  for (const fcl::Triangle& t : box.triangles) {
    if (unit(random) < 0.05) continue;
    const std::size_t first = scan.vertices.size();
    for (std::size_t k = 0; k < 3; ++k) {
      const fcl::Vector3d off(noise(random), noise(random), noise(random));
      scan.vertices.emplace_back(box.vertices[t[static_cast<int>(k)]] + off);
    }
    scan.triangles.emplace_back(first, first + 1, first + 2);
  }
  const auto model = kios::makeModel(scan.vertices, scan.triangles);
  const kios::WindingTree tree(*model);

  Eigen::Matrix3Xd points(3, 20000);
  for (Eigen::Index i = 0; i < points.size(); ++i) points(i % 3, i / 3) = 2 * unit(random) - 1;
  Eigen::VectorXd distances(points.cols());
  kios::PointRequest request;
  request.winding = &tree;
  kios::signedDistances(*model, points, distances, request);

  int inside = 0, near = 0, wrong = 0;
  for (Eigen::Index i = 0; i < points.cols(); ++i) {
    const double height = points.col(i).lpNorm<Eigen::Infinity>() - 0.5;
    inside += distances[i] < 0 ? 1 : 0;
    // Within two edges of the surface the winding number says what the holes leave open.
    const bool is_near = std::abs(height) < 0.05;
    near += is_near ? 1 : 0;
    wrong += !is_near && (distances[i] < 0) != (height < 0) ? 1 : 0;
  }
  std::printf(
      "%zu of %zu triangles are left; of %d points %d are inside, %d near the surface;\n"
      "of the others %d have the wrong sign\n",
      scan.triangles.size(), box.triangles.size(), static_cast<int>(points.cols()), inside, near,
      wrong);
  return wrong == 0 ? 0 : 1;
}
