// SPDX-FileCopyrightText: 2026 The fcl_kios authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <memory>

#include "fcl/geometry/bvh/BVH_internal.h"
#include "fcl/geometry/bvh/detail/BV_fitter.h"
#include "fcl/geometry/bvh/detail/BV_splitter.h"
#include "fcl/math/triangle.h"
#include "fcl_kios/fit/fit.h"

// How fcl::BVHModel<kios::kIOS<S>> builds and refits. FCL's copy constructor shares fitter and
// splitter between models, so neither holds anything of a build: that lives with the thread which
// builds, from set() to clear(), and models may be built in many threads at once.

namespace kios::engine {
class TreeCache;
}

namespace fcl {
namespace detail {

/// Fits a node's kIOS to the distinct vertices of its triangles (or to its points). fit() throws
/// std::invalid_argument at a NaN or infinite vertex; the model then stays unfinished.
/// `model.bv_fitter.reset(new BVFitter<kios::kIOSd>(kios::FitMethod::kMethodII))` before
/// endModel() chooses the published fit;
/// kios::FitOptions chooses more. What queries prepare fits for itself, whatever is chosen here.
template <typename S_>
class BVFitter<kios::kIOS<S_>> : public BVFitterBase<kios::kIOS<S_>> {
 public:
  using S = S_;
  /// Throws std::invalid_argument for an angle out of range.
  explicit BVFitter(const kios::FitOptions& options = {});
  virtual ~BVFitter();

  void set(Vector3<S>* vertices, Triangle* tri_indices, BVHModelType type) override;
  void set(Vector3<S>* vertices, Vector3<S>* prev_vertices, Triangle* tri_indices,
           BVHModelType type) override;
  kios::kIOS<S> fit(unsigned int* primitive_indices, int num_primitives) override;
  void clear() override;

  /// What queries prepared of the models that share this fitter: a model and its copies.
  kios::engine::TreeCache& trees() const { return *trees_; }

 private:
  const kios::FitOptions options_;
  const std::unique_ptr<kios::engine::TreeCache> trees_;
};

/// Splits a node across the longest principal axis of its vertices: at the mean or the median of
/// the triangles' centroids, or at the centre of the box along the axes.
template <typename S_>
class BVSplitter<kios::kIOS<S_>> : public BVSplitterBase<kios::kIOS<S_>> {
 public:
  using S = S_;
  explicit BVSplitter(SplitMethodType method) : method_(method) {}
  virtual ~BVSplitter() = default;

  void set(Vector3<S>* vertices, Triangle* tri_indices, BVHModelType type) override;
  void computeRule(const kios::kIOS<S>& bv, unsigned int* primitive_indices,
                   int num_primitives) override;
  bool apply(const Vector3<S>& q) const override;
  void clear() override;

 private:
  const SplitMethodType method_;
};

extern template class BVFitter<kios::kIOS<double>>;
extern template class BVFitter<kios::kIOS<float>>;
extern template class BVSplitter<kios::kIOS<double>>;
extern template class BVSplitter<kios::kIOS<float>>;

}  // namespace detail
}  // namespace fcl
