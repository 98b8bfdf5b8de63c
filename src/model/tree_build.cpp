// SPDX-FileCopyrightText: 2026 The fcl_kios authors
// SPDX-License-Identifier: BSD-3-Clause
#include "model/tree_build.h"

#include <algorithm>

namespace kios {

template <typename S>
TreeBuild<S>::TreeBuild(const BuildGeometry<S>& geometry, const FitOptions& options,
                        fcl::detail::SplitMethodType method, std::size_t num_vertices)
    : model_(geometry), options_(options), method_(method), seen_(num_vertices, 0) {
  points_.reserve(model_.prev_vertices ? 2 * num_vertices : num_vertices);
}

template <typename S>
kIOS<S> TreeBuild<S>::fit(const unsigned int* primitives, int n) {
  if (n == 1 && model_.type == fcl::BVH_MODEL_TRIANGLES && !model_.prev_vertices) {
    const fcl::Triangle& t = model_.triangles[primitives[0]];
    const fcl::Vector3<S> corners[3] = {model_.vertices[t[0]], model_.vertices[t[1]],
                                        model_.vertices[t[2]]};
    return fitter_.fit(corners, 3, options_);
  }
  gather(primitives, n);
  fitted_ = primitives;
  fitted_count_ = n;
  return fitter_.fit(points_.data(), static_cast<int>(points_.size()), options_, &split_);
}

template <typename S>
void TreeBuild<S>::computeRule(const kIOS<S>& /*bv*/, const unsigned int* primitives, int n) {
  if (n < 2) return;
  // A fitter that isn't ours leaves no frame behind.
  if (fitted_ != primitives || fitted_count_ != n) fit(primitives, n);
  plane_.axis = split_.axis;
  plane_.origin = split_.center;
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
