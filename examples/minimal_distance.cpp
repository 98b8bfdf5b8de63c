// SPDX-FileCopyrightText: 2026 The fcl_kios authors
// SPDX-License-Identifier: BSD-3-Clause
//
// Two tetrahedra: whether they touch, how far apart they are and where, by FCL's own calls; then
// what only kios can say.
#include <fcl_kios/fcl_kios.h>

#include <iostream>

int main() {
  const std::vector<fcl::Vector3d> vertices = {{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {0, 0, 1}};
  const std::vector<fcl::Triangle> triangles = {{0, 2, 1}, {0, 1, 3}, {1, 2, 3}, {0, 3, 2}};
  const auto mesh = kios::makeModel(vertices, triangles);  // checks what FCL's own build can't
  const Eigen::IOFormat row(Eigen::StreamPrecision, Eigen::DontAlignCols, ", ", ", ");

  const fcl::Transform3d at_origin = fcl::Transform3d::Identity();
  const fcl::Transform3d aside = fcl::Translation3d(2, 0, 0) * at_origin;
  fcl::CollisionObjectd a(mesh, at_origin), b(mesh, aside);

  fcl::CollisionResultd contact;
  fcl::collide(&a, &b, fcl::CollisionRequestd(), contact);
  std::cout << "touching: " << (contact.isCollision() ? "yes" : "no") << '\n';

  fcl::DistanceResultd result;
  fcl::distance(&a, &b, fcl::DistanceRequestd(/*enable_nearest_points=*/true), result);
  std::cout << "distance: " << result.min_distance << ", of triangle " << result.b1
            << " of the first and " << result.b2 << " of the second, at ("
            << result.nearest_points[0].transpose().format(row) << ") and ("
            << result.nearest_points[1].transpose().format(row) << ")\n";

  // A bracket of the distance, good to a tenth, and a question that needs no distance.
  kios::DistanceBracketRequestd options;
  options.rel_err = 0.1;
  const auto answer = kios::distanceBracket(*mesh, at_origin, *mesh, aside, options);
  std::cout << "proven to lie in [" << answer.lower_bound << ", " << answer.upper_bound << "]\n"
            << "nearer than 0.5: "
            << (kios::closerThan(*mesh, at_origin, *mesh, aside, 0.5) ? "yes" : "no") << '\n';

  const bool as_expected = !contact.isCollision() && result.min_distance == 1 &&
                           answer.lower_bound <= 1 && 1 <= answer.upper_bound;
  return as_expected ? 0 : 1;
}
