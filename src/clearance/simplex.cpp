// SPDX-FileCopyrightText: 2026 The fcl_kios authors
// SPDX-License-Identifier: BSD-3-Clause
#include "clearance/simplex.h"

#include <Eigen/QR>

#include "volume/rounding.h"

namespace kios::exact {

using fcl::Vector3d;

void Simplex::add(const Vector3d& x, const Vector3d& y) {
  int kept = 0;
  for (int i = 0; i < size_; ++i) {
    if (point_[i].weight > 0) point_[kept++] = point_[i];
  }
  size_ = kept;
  if (size_ == 4) return;
  point_[size_++] = {x, y, 0};
  findNearest();
}

// Takes the nearest of the 15 faces whose weights are >= 0: every such combination is a point of
// the hull, so that rounding costs iterations, but never the truth of p and q.
void Simplex::findNearest() {
  double least = kInfinity;
  std::array<double, 4> best = {};
  for (int face = 1; face < 1 << size_; ++face) {
    int corner[4], corners = 0;
    for (int i = 0; i < size_; ++i) {
      if (face & (1 << i)) corner[corners++] = i;
    }
    const Vector3d first = point_[corner[0]].y - point_[corner[0]].x;
    std::array<double, 4> weight = {};
    weight[corner[0]] = 1;
    Vector3d nearest = first;
    if (corners > 1) {
      Eigen::Matrix<double, 3, Eigen::Dynamic, Eigen::ColMajor, 3, 3> edges(3, corners - 1);
      for (int i = 1; i < corners; ++i) {
        edges.col(i - 1) = (point_[corner[i]].y - point_[corner[i]].x) - first;
      }
      const Eigen::ColPivHouseholderQR<decltype(edges)> factors(edges);
      if (!(factors.maxPivot() > 0)) continue;  // one point, which is a face of its own
      const Eigen::Matrix<double, Eigen::Dynamic, 1, 0, 3, 1> along = factors.solve(-first);
      if (!along.allFinite()) continue;
      nearest += edges * along;
      for (int i = 1; i < corners; ++i) {
        weight[corner[i]] = along[i - 1];
        weight[corner[0]] -= along[i - 1];
      }
    }
    bool inside = nearest.norm() < least;
    for (int i = 0; i < corners; ++i) inside = inside && weight[corner[i]] >= 0;
    if (!inside) continue;
    least = nearest.norm();
    best = weight;
  }
  p_.setZero();
  q_.setZero();
  for (int i = 0; i < size_; ++i) {
    point_[i].weight = best[i];
    p_ += best[i] * point_[i].x;
    q_ += best[i] * point_[i].y;
  }
}

}  // namespace kios::exact
