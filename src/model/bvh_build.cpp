// SPDX-FileCopyrightText: 2026 The fcl_kios authors
// SPDX-License-Identifier: BSD-3-Clause
#include "fcl_kios/detail/bvh_build.h"

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <map>
#include <mutex>
#include <numeric>
#include <thread>
#include <utility>
#include <vector>

#include "fcl_kios/detail/bv_traits.h"
#include "volume/errors.h"

namespace kios {

/// One build or refit of a model's tree by a fitter or a splitter, over the model's arrays. It
/// lives no longer than the build, and nobody else sees it, so that copies of a model may be built
/// in many threads, and at any time in a thread's or a program's life.
template <typename S>
class TreeBuild {
 public:
  TreeBuild(const fcl::Vector3<S>* vertices, const fcl::Vector3<S>* prev_vertices,
            const fcl::Triangle* triangles, fcl::BVHModelType type)
      : vertices_(vertices), prev_vertices_(prev_vertices), triangles_(triangles), type_(type) {}

  /// The distinct vertices of some primitives, of a model that is updated the earlier ones too.
  const std::vector<fcl::Vector3<S>>& pointsOf(const unsigned int* primitives, int n) {
    points_.clear();
    if (++stamp_ == 0) {
      std::fill(seen_.begin(), seen_.end(), 0);
      stamp_ = 1;
    }
    const int corners = type_ == fcl::BVH_MODEL_POINTCLOUD ? 1 : 3;
    for (int i = 0; i < n; ++i) {
      for (int k = 0; k < corners; ++k) {
        const std::size_t id = corners == 1 ? primitives[i] : triangles_[primitives[i]][k];
        if (id >= seen_.size()) seen_.resize(std::max(id + 1, 2 * seen_.size()), 0);
        if (std::exchange(seen_[id], stamp_) == stamp_) continue;
        points_.push_back(vertices_[id]);
        if (prev_vertices_) points_.push_back(prev_vertices_[id]);
      }
    }
    return points_;
  }

  /// Lays the plane that divides some primitives across the longest axis of their volume.
  void layPlane(fcl::detail::SplitMethodType method, const kIOS<S>& bv,
                const unsigned int* primitives, int n) {
    if (n < 2) return;
    const fcl::OBB<S> box = toOBB(bv, fcl::Transform3<S>(fcl::Transform3<S>::Identity()));
    Eigen::Index longest;
    box.extent.maxCoeff(&longest);
    axis_ = box.axis.col(longest).template cast<double>();
    origin_ = box.To.template cast<double>();
    value_ = 0;
    if (method == fcl::detail::SPLIT_METHOD_BV_CENTER) return;
    heights_.clear();
    for (int i = 0; i < n; ++i) heights_.push_back(heightOf(primitives[i]));
    if (method == fcl::detail::SPLIT_METHOD_MEAN) {
      value_ = std::accumulate(heights_.begin(), heights_.end(), 0.0) / n;
      return;
    }
    const auto upper = heights_.begin() + n / 2;
    std::nth_element(heights_.begin(), upper, heights_.end());
    value_ = n % 2 == 1 ? *upper : (*upper + *std::max_element(heights_.begin(), upper)) / 2;
  }

  /// The side of a primitive's centroid.
  bool above(const fcl::Vector3<S>& q) const { return height(q) > value_; }

 private:
  double height(const fcl::Vector3<S>& q) const {
    return axis_.dot(q.template cast<double>() - origin_);
  }
  double heightOf(unsigned int primitive) const {
    if (type_ == fcl::BVH_MODEL_POINTCLOUD) return height(vertices_[primitive]);
    const fcl::Triangle& t = triangles_[primitive];
    return (height(vertices_[t[0]]) + height(vertices_[t[1]]) + height(vertices_[t[2]])) / 3;
  }

  const fcl::Vector3<S>* const vertices_;
  const fcl::Vector3<S>* const prev_vertices_;  ///< nullptr unless the model is updated
  const fcl::Triangle* const triangles_;
  const fcl::BVHModelType type_;

  std::vector<fcl::Vector3<S>> points_;
  std::vector<std::uint32_t> seen_;  ///< per vertex, the stamp of the last fit that took it
  std::uint32_t stamp_ = 0;

  // Half-space that a node's primitives are divided by: axis . (q - origin) > value.
  Eigen::Vector3d origin_ = Eigen::Vector3d::Zero(), axis_ = Eigen::Vector3d::UnitX();
  double value_ = 0;
  std::vector<double> heights_;
};

/// The builds of one fitter or splitter: one a thread, from set() to clear(). They belong to it and
/// not to the threads, so that nothing of them is left, or gone, where a thread ends.
template <typename S>
class BuildsByThread {
 public:
  void start(const fcl::Vector3<S>* vertices, const fcl::Vector3<S>* prev_vertices,
             const fcl::Triangle* triangles, fcl::BVHModelType type) {
    auto build = std::make_unique<TreeBuild<S>>(vertices, prev_vertices, triangles, type);
    const std::lock_guard<std::mutex> lock(mutex_);
    builds_[std::this_thread::get_id()] = std::move(build);
  }

  TreeBuild<S>& current() {
    const std::lock_guard<std::mutex> lock(mutex_);
    const auto mine = builds_.find(std::this_thread::get_id());
    if (mine != builds_.end()) return *mine->second;
    refuse<std::logic_error>(
        "this BVFitter or BVSplitter was not set; set() it in the same thread before use.");
  }

  void end() {
    const std::lock_guard<std::mutex> lock(mutex_);
    builds_.erase(std::this_thread::get_id());
  }

 private:
  std::mutex mutex_;
  std::map<std::thread::id, std::unique_ptr<TreeBuild<S>>> builds_;
};

}  // namespace kios

namespace fcl {
namespace detail {

template <typename S>
BVFitter<kios::kIOS<S>>::BVFitter() : builds_(std::make_unique<kios::BuildsByThread<S>>()) {}

template <typename S>
BVFitter<kios::kIOS<S>>::~BVFitter() = default;

template <typename S>
void BVFitter<kios::kIOS<S>>::set(Vector3<S>* vertices, Triangle* tri_indices, BVHModelType type) {
  BVFitter::set(vertices, nullptr, tri_indices, type);
}

template <typename S>
void BVFitter<kios::kIOS<S>>::set(Vector3<S>* vertices, Vector3<S>* prev_vertices,
                                  Triangle* tri_indices, BVHModelType type) {
  builds_->start(vertices, prev_vertices, tri_indices, type);
}

template <typename S>
kios::kIOS<S> BVFitter<kios::kIOS<S>>::fit(unsigned int* primitive_indices, int num_primitives) {
  const auto& points = builds_->current().pointsOf(primitive_indices, num_primitives);
  return fitPoints(points.data(), static_cast<int>(points.size()));
}

template <typename S>
kios::kIOS<S> BVFitter<kios::kIOS<S>>::fitPoints(const Vector3<S>* points, int n) const {
  kios::kIOS<S> bv;
  kios::fit(points, n, bv);
  return bv;
}

template <typename S>
void BVFitter<kios::kIOS<S>>::clear() {
  builds_->end();
}

template <typename S>
BVSplitter<kios::kIOS<S>>::BVSplitter()
    : method_(SPLIT_METHOD_MEAN),
      by_cost_(true),
      builds_(std::make_unique<kios::BuildsByThread<S>>()) {}

template <typename S>
BVSplitter<kios::kIOS<S>>::BVSplitter(SplitMethodType method)
    : method_(method), by_cost_(false), builds_(std::make_unique<kios::BuildsByThread<S>>()) {}

template <typename S>
BVSplitter<kios::kIOS<S>>::~BVSplitter() = default;

template <typename S>
void BVSplitter<kios::kIOS<S>>::set(Vector3<S>* vertices, Triangle* tri_indices,
                                    BVHModelType type) {
  builds_->start(vertices, nullptr, tri_indices, type);
}

template <typename S>
void BVSplitter<kios::kIOS<S>>::computeRule(const kios::kIOS<S>& bv,
                                            unsigned int* primitive_indices, int num_primitives) {
  builds_->current().layPlane(method_, bv, primitive_indices, num_primitives);
}

template <typename S>
bool BVSplitter<kios::kIOS<S>>::apply(const Vector3<S>& q) const {
  return builds_->current().above(q);
}

template <typename S>
void BVSplitter<kios::kIOS<S>>::clear() {
  builds_->end();
}

template class BVFitter<kios::kIOS<double>>;
template class BVFitter<kios::kIOS<float>>;
template class BVSplitter<kios::kIOS<double>>;
template class BVSplitter<kios::kIOS<float>>;

}  // namespace detail
}  // namespace fcl
