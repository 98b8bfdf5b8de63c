// SPDX-FileCopyrightText: 2026 The fcl_kios authors
// SPDX-License-Identifier: BSD-3-Clause
#include "fcl_kios/fcl/bvh_build.h"

#include <algorithm>
#include <cstdint>
#include <stdexcept>
#include <vector>

#include "engine/tree_cache.h"
#include "fit/sphere_fitter.h"

namespace kios {
namespace {

/// Half-space that a node's primitives are divided by: axis . (q - origin) > value.
struct SplitPlane {
  Eigen::Vector3d origin = Eigen::Vector3d::Zero();
  Eigen::Vector3d axis = Eigen::Vector3d::UnitX();
  double value = 0;
};

/// What a thread knows of the model that it is building.
template <typename S>
class Build {
 public:
  static Build& ofThread() {
    if (!active_) {
      thread_local Build build;
      active_ = &build;
    }
    return *active_;
  }

  /// A fitter and a splitter share what they know of a build; each must be the one that was set
  /// last, so that a build within a build is refused, not mixed up.
  void setFitter(const void* fitter, const fcl::Vector3<S>* vertices,
                 const fcl::Vector3<S>* prev_vertices, const fcl::Triangle* triangles,
                 fcl::BVHModelType type) {
    setGeometry(vertices, triangles, type);
    prev_vertices_ = prev_vertices;
    fitter_owner_ = fitter;
  }
  void setSplitter(const void* splitter, const fcl::Vector3<S>* vertices,
                   const fcl::Triangle* triangles, fcl::BVHModelType type) {
    setGeometry(vertices, triangles, type);
    splitter_owner_ = splitter;
  }
  void clear(const void* owner) {
    if (fitter_owner_ == owner) fitter_owner_ = nullptr;
    if (splitter_owner_ == owner) splitter_owner_ = nullptr;
    if (fitter_owner_ || splitter_owner_) return;
    setGeometry(nullptr, nullptr, fcl::BVH_MODEL_UNKNOWN);
    fitter_.releaseLarge();
    constexpr std::size_t kKeep = 4096;
    if (points_.capacity() > kKeep) std::vector<fcl::Vector3<S>>().swap(points_);
    if (seen_.capacity() > kKeep) std::vector<std::uint32_t>().swap(seen_);
  }
  void requireFitter(const void* fitter) const { requireOwner(fitter, fitter_owner_); }
  void requireSplitter(const void* splitter) const { requireOwner(splitter, splitter_owner_); }

  kIOS<S> fit(const unsigned int* primitives, int n, const FitOptions& options) {
    if (n == 1 && type_ == fcl::BVH_MODEL_TRIANGLES && !prev_vertices_) {
      const fcl::Triangle& t = triangles_[primitives[0]];
      const fcl::Vector3<S> corners[3] = {vertices_[t[0]], vertices_[t[1]], vertices_[t[2]]};
      return fitter_.fit(corners, 3, options);
    }
    gather(primitives, n);
    fitted_ = primitives;
    fitted_count_ = n;
    return fitter_.fit(points_.data(), static_cast<int>(points_.size()), options, &split_);
  }

  void computeRule(const unsigned int* primitives, int n, fcl::detail::SplitMethodType method) {
    if (n < 2) return;
    // A fitter that isn't ours leaves no frame behind.
    if (fitted_ != primitives || fitted_count_ != n) fit(primitives, n, FitMethod::kTuned);
    plane_.axis = split_.axis;
    plane_.origin = split_.center;
    switch (method) {
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

  bool above(const fcl::Vector3<S>& q) const { return height(q) > plane_.value; }

 private:
  double height(const fcl::Vector3<S>& q) const {
    return plane_.axis.dot(q.template cast<double>() - plane_.origin);
  }

  /// Geometry other than what is set starts another build.
  void setGeometry(const fcl::Vector3<S>* vertices, const fcl::Triangle* triangles,
                   fcl::BVHModelType type) {
    if (vertices != vertices_ || triangles != triangles_) fitter_owner_ = splitter_owner_ = nullptr;
    vertices_ = vertices;
    prev_vertices_ = nullptr;
    triangles_ = triangles;
    type_ = type;
    fitted_ = nullptr;
  }

  static void requireOwner(const void* asking, const void* owner) {
    if (asking == owner) return;
    throw std::logic_error(
        "fcl_kios: this BVFitter or BVSplitter is not the one that its thread set last; set() it "
        "before use, and build no other model in between.");
  }

  /// The distinct vertices of the primitives, and the mean of all corners (= of the centroids).
  void gather(const unsigned int* primitives, int n) {
    points_.clear();
    if (type_ == fcl::BVH_MODEL_POINTCLOUD) {
      Eigen::Vector3d sum = Eigen::Vector3d::Zero();
      const Eigen::Vector3d first = vertices_[primitives[0]].template cast<double>();
      for (int i = 0; i < n; ++i) {
        add(primitives[i]);
        sum += vertices_[primitives[i]].template cast<double>() - first;
      }
      mean_ = first + sum / n;
      return;
    }
    if (++stamp_ == 0) {
      std::fill(seen_.begin(), seen_.end(), 0);
      stamp_ = 1;
    }
    const fcl::Vector3<S>& first = vertices_[triangles_[primitives[0]][0]];
    const double x0 = first[0], y0 = first[1], z0 = first[2];
    double sx = 0, sy = 0, sz = 0;
    for (int i = 0; i < n; ++i) {
      const fcl::Triangle& triangle = triangles_[primitives[i]];
      for (int corner = 0; corner < 3; ++corner) {
        const std::size_t id = triangle[corner];
        const fcl::Vector3<S>& v = vertices_[id];
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

  void add(std::size_t id) {
    points_.push_back(vertices_[id]);
    if (prev_vertices_) points_.push_back(prev_vertices_[id]);
  }

  double medianHeight(const unsigned int* primitives, int n) {
    heights_.resize(n);
    for (int i = 0; i < n; ++i) {
      if (type_ == fcl::BVH_MODEL_POINTCLOUD) {
        heights_[i] = height(vertices_[primitives[i]]);
        continue;
      }
      const fcl::Triangle& t = triangles_[primitives[i]];
      heights_[i] =
          (height(vertices_[t[0]]) + height(vertices_[t[1]]) + height(vertices_[t[2]])) / 3;
    }
    const auto upper = heights_.begin() + n / 2;
    std::nth_element(heights_.begin(), upper, heights_.end());
    if (n % 2 == 1) return *upper;
    return (*upper + *std::max_element(heights_.begin(), upper)) / 2;
  }

  // Found without a call: a split asks for it once a primitive.
  __attribute__((tls_model("initial-exec"))) static thread_local Build* active_;

  const void* fitter_owner_ = nullptr;
  const void* splitter_owner_ = nullptr;
  const fcl::Vector3<S>* vertices_ = nullptr;
  const fcl::Vector3<S>* prev_vertices_ = nullptr;
  const fcl::Triangle* triangles_ = nullptr;
  fcl::BVHModelType type_ = fcl::BVH_MODEL_UNKNOWN;

  SphereFitter<S> fitter_;
  std::vector<fcl::Vector3<S>> points_;
  std::vector<std::uint32_t> seen_;  ///< per vertex, the stamp of the last fit that took it
  std::uint32_t stamp_ = 0;
  std::vector<double> heights_;

  // Left by a fit for the split of the same primitives.
  const unsigned int* fitted_ = nullptr;
  int fitted_count_ = 0;
  typename SphereFitter<S>::Split split_;
  Eigen::Vector3d mean_ = Eigen::Vector3d::Zero();
  SplitPlane plane_;
};

template <typename S>
thread_local Build<S>* Build<S>::active_ = nullptr;

}  // namespace
}  // namespace kios

namespace fcl {
namespace detail {

template <typename S>
BVFitter<kios::kIOS<S>>::BVFitter(const kios::FitOptions& options)
    : options_(options), trees_(std::make_unique<kios::engine::TreeCache>()) {
  kios::requireUsable(options);
}

template <typename S>
BVFitter<kios::kIOS<S>>::~BVFitter() = default;

template <typename S>
void BVFitter<kios::kIOS<S>>::set(Vector3<S>* vertices, Triangle* tri_indices, BVHModelType type) {
  kios::Build<S>::ofThread().setFitter(this, vertices, nullptr, tri_indices, type);
}

template <typename S>
void BVFitter<kios::kIOS<S>>::set(Vector3<S>* vertices, Vector3<S>* prev_vertices,
                                  Triangle* tri_indices, BVHModelType type) {
  kios::Build<S>::ofThread().setFitter(this, vertices, prev_vertices, tri_indices, type);
}

template <typename S>
kios::kIOS<S> BVFitter<kios::kIOS<S>>::fit(unsigned int* primitive_indices, int num_primitives) {
  auto& build = kios::Build<S>::ofThread();
  build.requireFitter(this);
  return build.fit(primitive_indices, num_primitives, options_);
}

template <typename S>
void BVFitter<kios::kIOS<S>>::clear() {
  kios::Build<S>::ofThread().clear(this);
}

template <typename S>
void BVSplitter<kios::kIOS<S>>::set(Vector3<S>* vertices, Triangle* tri_indices,
                                    BVHModelType type) {
  kios::Build<S>::ofThread().setSplitter(this, vertices, tri_indices, type);
}

template <typename S>
void BVSplitter<kios::kIOS<S>>::computeRule(const kios::kIOS<S>& /*bv*/,
                                            unsigned int* primitive_indices, int num_primitives) {
  auto& build = kios::Build<S>::ofThread();
  build.requireSplitter(this);
  build.computeRule(primitive_indices, num_primitives, method_);
}

template <typename S>
bool BVSplitter<kios::kIOS<S>>::apply(const Vector3<S>& q) const {
  return kios::Build<S>::ofThread().above(q);
}

template <typename S>
void BVSplitter<kios::kIOS<S>>::clear() {
  kios::Build<S>::ofThread().clear(this);
}

template class BVFitter<kios::kIOS<double>>;
template class BVFitter<kios::kIOS<float>>;
template class BVSplitter<kios::kIOS<double>>;
template class BVSplitter<kios::kIOS<float>>;

}  // namespace detail
}  // namespace fcl
