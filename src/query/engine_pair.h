// SPDX-FileCopyrightText: 2026 The fcl_kios authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <algorithm>
#include <optional>

#include "engine/mesh_search.h"
#include "model/prepared.h"

namespace kios {

/// Two models with their trees, which stay in use while it lives.
template <typename S>
class EnginePair {
 public:
  EnginePair(const Model<S>& model1, const Model<S>& model2, const RelativePose<S>& X_12)
      : model1_(model1), model2_(model2), X_12_(X_12) {
    if (tooFar()) return;  // before anything is prepared in vain
    tree1_.emplace(preparedTree(model1));
    if (!*tree1_) return;
    tree2_.emplace(preparedTree(model2));
    usable_ = *tree2_ && engine::makeFramePair(**tree1_, **tree2_, X_12, frames_);
  }

  /// False if FCL's tree must do.
  explicit operator bool() const { return usable_; }

  engine::PreparedPair<S> pair() const {
    return {{**tree1_, viewOf(model1_)}, {**tree2_, viewOf(model2_)}, X_12_, frames_};
  }

 private:
  /// Whether the models are so far apart for their size that makeFramePair() would refuse: its pad
  /// then is a radius of the smaller.
  bool tooFar() const {
    const kIOS<S>&a = model1_.getBV(0).bv, &b = model2_.getBV(0).bv;
    const double apart = (X_12_ * b.center0 - a.center0).template cast<double>().norm();
    return 0x1p-19 * apart > std::min<double>(a.radius0, b.radius0);
  }

  const Model<S>&model1_, &model2_;
  const RelativePose<S>& X_12_;
  std::optional<engine::TreeCache::Use> tree1_, tree2_;
  engine::FramePair frames_;
  bool usable_ = false;
};

}  // namespace kios
