// SPDX-FileCopyrightText: 2026 The fcl_kios authors
// SPDX-License-Identifier: BSD-3-Clause
#include "fcl_kios/model/bvh_build.h"

#include <map>
#include <mutex>
#include <thread>
#include <utility>

#include "model/tree_build.h"
#include "volume/errors.h"

namespace kios {

/// The builds of one fitter or splitter: one a thread, from set() to clear(). They belong to it and
/// not to the threads, so that nothing of them is left, or gone, where a thread ends.
template <typename S>
class BuildsByThread {
 public:
  void start(const BuildGeometry<S>& geometry, fcl::detail::SplitMethodType method,
             const typename TreeBuild<S>::Fitter* fitter = nullptr) {
    auto build = std::make_unique<TreeBuild<S>>(geometry, method, fitter);
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
  builds_->start({vertices, prev_vertices, tri_indices, type}, SPLIT_METHOD_MEAN, this);
}

template <typename S>
kios::kIOS<S> BVFitter<kios::kIOS<S>>::fit(unsigned int* primitive_indices, int num_primitives) {
  return builds_->current().fit(primitive_indices, num_primitives);
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
  builds_->start({vertices, nullptr, tri_indices, type}, method_);
}

template <typename S>
void BVSplitter<kios::kIOS<S>>::computeRule(const kios::kIOS<S>& bv,
                                            unsigned int* primitive_indices, int num_primitives) {
  builds_->current().computeRule(bv, primitive_indices, num_primitives);
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
