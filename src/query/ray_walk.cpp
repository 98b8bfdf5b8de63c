// SPDX-FileCopyrightText: 2026 The fcl_kios authors
// SPDX-License-Identifier: BSD-3-Clause
#include "query/ray_walk.h"

#include <cmath>

#include "model/prepared.h"
#include "model/walk.h"
#include "search/search.h"
#include "volume/rounding.h"

namespace kios {

template <typename S>
void RayWalk<S>::walk() {
  double enter, exit;
  if (!reaches(0, enter, exit)) return;
  const engine::TreeCache::Use tree = preparedTree(model_);
  engine::FloatRay ray;
  const engine::RayFit fit =
      tree ? engine::makeFloatRay(*tree, line_, ray_.t_min, ray_.t_max, near_, ray)
           : engine::RayFit::kRefused;
  if (fit == engine::RayFit::kMiss) return;
  if (fit == engine::RayFit::kRefused) return walkFCLTree(enter);
  tree_ = &*tree;
  this->end = ray.end;
  engine::kernels().ray({*tree, ray, *this, counts_});
}

template <typename S>
void RayWalk<S>::endAt(double t) {
  last_ = t;
  if (tree_) this->end = engine::toLength(*tree_, line_.lengthOf(last_, near_.t, 0));
}

/// Front to back, in double.
template <typename S>
void RayWalk<S>::walkFCLTree(double enter) {
  ++counts_.tree_searches;
  const auto skip = [this](const BoundedNode& at) { return at.bound > last_; };
  walkNearestFirst(BoundedNode{enter, 0}, skip, [&](const BoundedNode& at, const auto& add) {
    const auto& node = model_.getBV(at.node);
    if (node.isLeaf()) {
      ++counts_.leaf_pairs;
      return this->evaluate(static_cast<std::uint32_t>(node.primitiveId()));
    }
    ++counts_.expansions;
    counts_.volume_tests += 2;
    for (const int child : {node.rightChild(), node.leftChild()}) {
      double from, to;
      if (reaches(child, from, to)) add({from, child});
    }
    return false;
  });
}

/// A hit's t is rounded, so that it may lie beyond the exact one by half an ulp.
template <typename S>
bool RayWalk<S>::reaches(int node, double& enter, double& exit) const {
  return rayInterval(model_.getBV(node).bv, line_, enter, exit) && exit >= ray_.t_min &&
         enter <= std::nextafter(last_, kInfinity);
}

template class RayWalk<double>;
template class RayWalk<float>;

}  // namespace kios
