// SPDX-FileCopyrightText: 2026 The fcl_kios authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

#include <fcl/geometry/bvh/BVH_internal.h>
#include <fcl/math/triangle.h>
#include "fcl_kios/model/bvh_build.h"

namespace kios {

/// The geometry that a build fits volumes to. The arrays are the model's.
template <typename S>
struct BuildGeometry {
  const fcl::Vector3<S>* vertices = nullptr;
  const fcl::Vector3<S>* prev_vertices = nullptr;  ///< nullptr unless the model is updated
  const fcl::Triangle* triangles = nullptr;
  fcl::BVHModelType type = fcl::BVH_MODEL_UNKNOWN;
};

/// One build or refit of a model's tree: fits its nodes and divides them. It lives no longer than
/// the build, and nobody else sees it, so that copies of a model may be built in many threads, and
/// at any time in a thread's or a program's life.
template <typename S>
class TreeBuild {
 public:
  using Fitter = fcl::detail::BVFitter<kIOS<S>>;

  /// Fits by kios::fit(), or as a fitter does that is given.
  TreeBuild(const BuildGeometry<S>& geometry, fcl::detail::SplitMethodType method,
            const Fitter* fitter)
      : model_(geometry), method_(method), fitter_(fitter) {}

  kIOS<S> fit(const unsigned int* primitives, int n);

  /// Sets the plane that divides these primitives; the next to be asked after their fit.
  void computeRule(const kIOS<S>& bv, const unsigned int* primitives, int n);

  /// The side of a primitive's centroid.
  bool above(const fcl::Vector3<S>& q) const { return height(q) > plane_.value; }

 private:
  /// Half-space that a node's primitives are divided by: axis . (q - origin) > value.
  struct SplitPlane {
    Eigen::Vector3d origin = Eigen::Vector3d::Zero();
    Eigen::Vector3d axis = Eigen::Vector3d::UnitX();
    double value = 0;
  };

  double height(const fcl::Vector3<S>& q) const {
    return plane_.axis.dot(q.template cast<double>() - plane_.origin);
  }
  void gather(const unsigned int* primitives, int n);
  void placePlane();
  void add(std::size_t id);
  double medianHeight(const unsigned int* primitives, int n);

  const BuildGeometry<S> model_;
  const fcl::detail::SplitMethodType method_;
  const Fitter* const fitter_;
  std::vector<fcl::Vector3<S>> points_;
  std::vector<std::uint32_t> seen_;  ///< per vertex, the stamp of the last fit that took it
  std::uint32_t stamp_ = 0;
  std::vector<double> heights_;

  // The primitives whose points were gathered last, for their fit and their split.
  const unsigned int* gathered_ = nullptr;
  int gathered_count_ = 0;
  Eigen::Vector3d mean_ = Eigen::Vector3d::Zero();
  SplitPlane plane_;
};

}  // namespace kios
