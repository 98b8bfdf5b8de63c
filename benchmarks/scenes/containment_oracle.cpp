// SPDX-FileCopyrightText: 2026 The fcl_kios authors
// SPDX-License-Identifier: BSD-3-Clause

#include "containment_oracle.h"

#include <algorithm>
#include <cmath>
#include <stdexcept>

#include "random.h"
#include "ray_oracle.h"

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

ContainmentOracle::ContainmentOracle(const Mesh& mesh) {
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

ContainmentOracle::Place ContainmentOracle::placeOf(const Eigen::Vector3d& point) const {
  Random random(17);
  const double size = 1e-12 * (reach_ + point.lpNorm<Eigen::Infinity>());
  constexpr int kRays = 100;
  for (int i = 0; i < kRays; ++i) {
    Eigen::Vector3d direction;
    for (int c = 0; c < 3; ++c) direction[c] = random.uniform(-1, 1);
    const double length = direction.norm();
    if (!(length > 0.1)) continue;
    int winding = 0;
    bool usable = true;
    for (std::size_t t = 0; t < triangles_.size(); ++t) {
      const Eigen::Vector3d to = balls_[t].first - point;
      if (to.cross(direction).norm() / length > 1.001 * balls_[t].second + size) continue;
      const auto hit = rationalRayHit({point, direction, 0, 1e300}, triangles_[t]);
      if (!hit) continue;
      if (hit->t == 0) return Place::kSurface;
      usable &= hit->crosses && hit->weights[0] > 0 && hit->weights[1] > 0 && hit->weights[2] > 0;
      winding += hit->along_normal ? 1 : -1;
    }
    if (usable) return winding > 0 ? Place::kInside : Place::kOutside;
  }
  throw std::runtime_error("every ray of the oracle met an edge");
}

}  // namespace kios::scenes
