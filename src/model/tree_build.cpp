// SPDX-FileCopyrightText: 2026 The fcl_kios authors
// SPDX-License-Identifier: BSD-3-Clause
#include "model/tree_build.h"

#include <algorithm>

#include "build/four_axes.h"
#include "volume/balls.h"
#include "volume/rounding.h"

namespace kios {

template <typename S>
kIOS<S> TreeBuild<S>::fit(const unsigned int* primitives, int n) {
  gather(primitives, n);
  const int count = static_cast<int>(points_.size());
  if (fitter_) return fitter_->fitPoints(points_.data(), count);
  kIOS<S> bv;
  kios::fit(points_.data(), count, bv);
  return bv;
}

/// Lays the plane across the longest principal axis of the gathered points, through the middle of
/// the box along the axes. Units of a power of two keep squares finite.
template <typename S>
void TreeBuild<S>::placePlane() {
  const Eigen::Vector3d first = points_[0].template cast<double>();
  double largest = 0;
  for (const fcl::Vector3<S>& p : points_) {
    largest = std::max(largest, (p.template cast<double>() - first).cwiseAbs().maxCoeff());
  }
  const int exponent = largest > 0 ? exponentOf(largest) : 0;
  const auto place = [&](const fcl::Vector3<S>& p) {
    const Eigen::Vector3d d = p.template cast<double>() - first;
    return Eigen::Vector3d(scaled(d[0], -exponent), scaled(d[1], -exponent),
                           scaled(d[2], -exponent));
  };
  Scatter<double> s;
  for (const fcl::Vector3<S>& p : points_) {
    const Eigen::Vector3d at = place(p);
    s.add(at[0], at[1], at[2]);
  }
  s.center(1 / static_cast<double>(points_.size()));
  const auto single = [](double v) { return roundedTo<float>(v); };
  const Eigen::Matrix3d axes =
      principalAxes(Scatter<float>{0, 0, 0, single(s.xx), single(s.xy), single(s.xz), single(s.yy),
                                   single(s.yz), single(s.zz)})
          .template cast<double>();
  Eigen::Vector3d low = Eigen::Vector3d::Zero(), high = low;  // the first point lies at 0
  for (const fcl::Vector3<S>& p : points_) {
    const Eigen::Vector3d at = axes.transpose() * place(p);
    low = low.cwiseMin(at);
    high = high.cwiseMax(at);
  }
  const Eigen::Vector3d middle = 0.5 * (axes * (low + high));
  for (int c = 0; c < 3; ++c) plane_.origin[c] = first[c] + scaled(middle[c], exponent);
  plane_.axis = axes.col(longestFirst(high - low)[0]);
}

template <typename S>
void TreeBuild<S>::computeRule(const kIOS<S>& /*bv*/, const unsigned int* primitives, int n) {
  if (n < 2) return;
  if (gathered_ != primitives || gathered_count_ != n) gather(primitives, n);
  placePlane();
  switch (method_) {
    case fcl::detail::SPLIT_METHOD_MEAN:
      plane_.origin = mean_;
      plane_.value = 0;
      break;
    case fcl::detail::SPLIT_METHOD_MEDIAN:
      plane_.value = medianHeight(primitives, n);
      break;
    case fcl::detail::SPLIT_METHOD_BV_CENTER:
      plane_.value = 0;
      break;
  }
}

/// The distinct vertices of the primitives, and the mean of all corners (= of the centroids).
template <typename S>
void TreeBuild<S>::gather(const unsigned int* primitives, int n) {
  gathered_ = primitives;
  gathered_count_ = n;
  points_.clear();
  if (model_.type == fcl::BVH_MODEL_POINTCLOUD) {
    Eigen::Vector3d sum = Eigen::Vector3d::Zero();
    const Eigen::Vector3d first = model_.vertices[primitives[0]].template cast<double>();
    for (int i = 0; i < n; ++i) {
      add(primitives[i]);
      sum += model_.vertices[primitives[i]].template cast<double>() - first;
    }
    mean_ = first + sum / n;
    return;
  }
  if (++stamp_ == 0) {
    std::fill(seen_.begin(), seen_.end(), 0);
    stamp_ = 1;
  }
  const fcl::Vector3<S>& first = model_.vertices[model_.triangles[primitives[0]][0]];
  const double x0 = first[0], y0 = first[1], z0 = first[2];
  double sx = 0, sy = 0, sz = 0;
  for (int i = 0; i < n; ++i) {
    const fcl::Triangle& triangle = model_.triangles[primitives[i]];
    for (int corner = 0; corner < 3; ++corner) {
      const std::size_t id = triangle[corner];
      const fcl::Vector3<S>& v = model_.vertices[id];
      sx += v[0] - x0;
      sy += v[1] - y0;
      sz += v[2] - z0;
      if (id >= seen_.size()) seen_.resize(std::max(id + 1, 2 * seen_.size()), 0);
      if (seen_[id] == stamp_) continue;
      seen_[id] = stamp_;
      add(id);
    }
  }
  const double corners = 3.0 * n;
  mean_ = {x0 + sx / corners, y0 + sy / corners, z0 + sz / corners};
}

template <typename S>
void TreeBuild<S>::add(std::size_t id) {
  points_.push_back(model_.vertices[id]);
  if (model_.prev_vertices) points_.push_back(model_.prev_vertices[id]);
}

template <typename S>
double TreeBuild<S>::medianHeight(const unsigned int* primitives, int n) {
  heights_.resize(n);
  for (int i = 0; i < n; ++i) {
    if (model_.type == fcl::BVH_MODEL_POINTCLOUD) {
      heights_[i] = height(model_.vertices[primitives[i]]);
      continue;
    }
    const fcl::Triangle& t = model_.triangles[primitives[i]];
    heights_[i] = (height(model_.vertices[t[0]]) + height(model_.vertices[t[1]]) +
                   height(model_.vertices[t[2]])) /
                  3;
  }
  const auto upper = heights_.begin() + n / 2;
  std::nth_element(heights_.begin(), upper, heights_.end());
  if (n % 2 == 1) return *upper;
  return (*upper + *std::max_element(heights_.begin(), upper)) / 2;
}

template class TreeBuild<double>;
template class TreeBuild<float>;

}  // namespace kios
