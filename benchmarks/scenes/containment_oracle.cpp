// SPDX-FileCopyrightText: 2026 The fcl_kios authors
// SPDX-License-Identifier: BSD-3-Clause

#include "containment_oracle.h"

#include <algorithm>
#include <cmath>
#include <stdexcept>

#include "random.h"

namespace kios::scenes {

long double windingOf(const std::array<Eigen::Vector3d, 3>& triangle,
                      const Eigen::Vector3d& point) {
  using Row = Eigen::Matrix<long double, 3, 1>;
  Row v[3];
  for (std::size_t k = 0; k < 3; ++k) {
    v[k] = triangle[k].cast<long double>() - point.cast<long double>();
  }
  const long double a = v[0].norm(), b = v[1].norm(), c = v[2].norm();
  const long double angle =
      std::atan2(v[0].dot(v[1].cross(v[2])),
                 a * b * c + v[0].dot(v[1]) * c + v[1].dot(v[2]) * a + v[2].dot(v[0]) * b);
  return angle / 6.28318530717958647692528676655900577L;
}

RayOracle::RayOracle(const Mesh& mesh) {
  for (const fcl::Triangle& t : mesh.triangles) {
    const std::array<Eigen::Vector3d, 3> corners = {mesh.vertices[t[0]], mesh.vertices[t[1]],
                                                    mesh.vertices[t[2]]};
    const Eigen::Vector3d center = (corners[0] + corners[1] + corners[2]) / 3;
    double radius = 0;
    for (const Eigen::Vector3d& p : corners) {
      radius = std::max(radius, (p - center).norm());
      reach_ = std::max(reach_, p.lpNorm<Eigen::Infinity>());
    }
    triangles_.push_back(corners);
    balls_.emplace_back(center, radius);
  }
}

std::vector<RayOracle::Hit> RayOracle::hits(const RationalRay& ray) const {
  const double size = 1e-12 * (reach_ + ray.origin.lpNorm<Eigen::Infinity>());
  const double length = ray.direction.norm();
  std::vector<Hit> hits;
  for (std::size_t t = 0; t < triangles_.size(); ++t) {
    const auto& [center, radius] = balls_[t];
    if ((center - ray.origin).cross(ray.direction).norm() / length > 1.001 * radius + size)
      continue;
    if (const auto hit = rationalRayHit(ray, triangles_[t])) {
      hits.push_back({*hit, static_cast<int>(t)});
    }
  }
  return hits;
}

ContainmentOracle::Place ContainmentOracle::placeOf(const Eigen::Vector3d& point) const {
  Random random(17);
  constexpr int kRays = 100;
  for (int i = 0; i < kRays; ++i) {
    const Eigen::Vector3d direction = random.inCube(-1, 1);
    if (!(direction.norm() > 0.1)) continue;
    int winding = 0;
    bool usable = true;
    for (const RayOracle::Hit& hit : rays_.hits({point, direction, 0, 1e300})) {
      if (hit.t == 0) return Place::kSurface;
      usable &= hit.crosses && hit.weights[0] > 0 && hit.weights[1] > 0 && hit.weights[2] > 0;
      winding += hit.along_normal ? 1 : -1;
    }
    if (usable) return winding > 0 ? Place::kInside : Place::kOutside;
  }
  throw std::runtime_error("every ray of the oracle met an edge");
}

}  // namespace kios::scenes
