// SPDX-FileCopyrightText: 2026 The fcl_kios authors
// SPDX-License-Identifier: BSD-3-Clause
#include "query/ray_walk.h"

#include <cmath>
#include <utility>
#include <vector>

#include "model/prepared.h"
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
  struct Waiting {
    double enter;
    int node;
  };
  std::vector<Waiting> waiting = {{enter, 0}};
  while (!waiting.empty()) {
    const Waiting at = waiting.back();
    waiting.pop_back();
    if (at.enter > last_) continue;
    const auto& node = model_.getBV(at.node);
    if (node.isLeaf()) {
      ++counts_.leaf_pairs;
      if (this->evaluate(static_cast<std::uint32_t>(node.primitiveId()))) return;
      continue;
    }
    ++counts_.expansions;
    counts_.volume_tests += 2;
    Waiting children[2] = {{0, node.leftChild()}, {0, node.rightChild()}};
    double exit;
    const bool left = reaches(children[0].node, children[0].enter, exit);
    const bool right = reaches(children[1].node, children[1].enter, exit);
    const bool left_first = !right || (left && children[0].enter <= children[1].enter);
    if (left_first) std::swap(children[0], children[1]);  // the nearest last
    if (left_first ? right : left) waiting.push_back(children[0]);
    if (left_first ? left : right) waiting.push_back(children[1]);
  }
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
