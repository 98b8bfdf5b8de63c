// SPDX-FileCopyrightText: 2026 The fcl_kios authors
// SPDX-License-Identifier: BSD-3-Clause

#pragma once

#include <fcl/geometry/bvh/detail/BV_fitter.h>

namespace kios::scenes {

/// A fitter of the user's own that fits as FCL's does.
template <typename BV>
class ForeignFitter final : public fcl::detail::BVFitterBase<BV> {
 public:
  using V = fcl::Vector3<typename BV::S>;
  void set(V* v, fcl::Triangle* t, fcl::BVHModelType type) override { fitter_.set(v, t, type); }
  void set(V* v, V* previous, fcl::Triangle* t, fcl::BVHModelType type) override {
    fitter_.set(v, previous, t, type);
  }
  BV fit(unsigned int* primitives, int n) override { return fitter_.fit(primitives, n); }
  void clear() override { fitter_.clear(); }

 private:
  fcl::detail::BVFitter<BV> fitter_;
};

}  // namespace kios::scenes
