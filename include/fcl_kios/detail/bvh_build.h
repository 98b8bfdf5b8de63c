// SPDX-FileCopyrightText: 2026 The fcl_kios authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <memory>

#include <fcl/geometry/bvh/BVH_internal.h>
#include <fcl/geometry/bvh/detail/BV_fitter.h>
#include <fcl/geometry/bvh/detail/BV_splitter.h>
#include <fcl/math/triangle.h>
#include "fcl_kios/volume.h"

// These classes build and refit fcl::BVHModel<kios::kIOS<S>>. FCL's copy constructor shares fitter
// and splitter between models, which may be built in many threads at once: each holds one state a
// thread, from set() to clear().

namespace kios {
template <typename S>
class BuildsByThread;
}  // namespace kios

namespace fcl {
namespace detail {

/// Fits a node's kIOS to the distinct vertices of its triangles (or to its points). fit() throws
/// std::invalid_argument at a NaN or infinite vertex; the model then stays unfinished. A class that
/// is derived from it and set as `model.bv_fitter` before endModel() may place spheres another way
/// in fitPoints(), as those of fcl_kios/paper.h do: FCL's traversals see that fit; the tree
/// that queries search has one of its own.
template <typename S_>
class BVFitter<kios::kIOS<S_>> : public BVFitterBase<kios::kIOS<S_>> {
 public:
  using S = S_;
  BVFitter();
  virtual ~BVFitter();

  void set(Vector3<S>* vertices, Triangle* tri_indices, BVHModelType type) override;
  void set(Vector3<S>* vertices, Vector3<S>* prev_vertices, Triangle* tri_indices,
           BVHModelType type) override;
  kios::kIOS<S> fit(unsigned int* primitive_indices, int num_primitives) override;
  void clear() override;

  /// Returns the volume of a node's points: kios::fit().
  virtual kios::kIOS<S> fitPoints(const Vector3<S>* points, int n) const;

 private:
  const std::unique_ptr<kios::BuildsByThread<S>> builds_;
};

/// Splits a node across the longest principal axis of its vertices: at the mean or the median of
/// the triangles' centroids, or at the centre of the box along the axes. One made without a method,
/// as models have it, splits by the cost of a search: with the BVFitter above, a mesh is then
/// divided and fitted in one go, in about half the time, and queries take its tree over. If that
/// can't be (a point cloud, another fitter, a mesh of no ordinary size), it splits at the mean.
template <typename S_>
class BVSplitter<kios::kIOS<S_>> : public BVSplitterBase<kios::kIOS<S_>> {
 public:
  using S = S_;
  BVSplitter();
  explicit BVSplitter(SplitMethodType method);
  virtual ~BVSplitter();

  void set(Vector3<S>* vertices, Triangle* tri_indices, BVHModelType type) override;
  void computeRule(const kios::kIOS<S>& bv, unsigned int* primitive_indices,
                   int num_primitives) override;
  bool apply(const Vector3<S>& q) const override;
  void clear() override;

  SplitMethodType method() const { return method_; }
  bool byCost() const { return by_cost_; }

 private:
  const SplitMethodType method_;
  const bool by_cost_;
  const std::unique_ptr<kios::BuildsByThread<S>> builds_;
};

extern template class BVFitter<kios::kIOS<double>>;
extern template class BVFitter<kios::kIOS<float>>;
extern template class BVSplitter<kios::kIOS<double>>;
extern template class BVSplitter<kios::kIOS<float>>;

}  // namespace detail
}  // namespace fcl
