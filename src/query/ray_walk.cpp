// SPDX-FileCopyrightText: 2026 The fcl_kios authors
// SPDX-License-Identifier: BSD-3-Clause
#include "query/ray_walk.h"

#include <cmath>

#include "model/prepared.h"
#include "search/search.h"
#include "volume/rounding.h"

namespace kios {

// The root volume tells exactly whether a ray reaches it, however far it comes from.
template <typename S>
void RayWalk<S>::walk() {
  double enter, exit;
  const bool reaches = rayInterval(model_.getBV(0).bv, line_, enter, exit) && exit >= ray_.t_min &&
                       enter <= std::nextafter(ray_.t_max, kInfinity);
  if (!reaches) return;
  const engine::Tree& tree = treeOf(model_);
  engine::FloatRay ray;
  const engine::RayFit fit = engine::makeFloatRay(tree, line_, ray_.t_min, ray_.t_max, near_, ray);
  if (fit == engine::RayFit::kMiss) return;
  if (fit == engine::RayFit::kServed) tree_ = &tree;
  this->end = ray.end;
  engine::kernels().ray({tree, ray, *this, counts_});
}

template <typename S>
void RayWalk<S>::endAt(double t) {
  if (tree_) this->end = engine::toLength(*tree_, line_.lengthOf(t, near_.t, tree_->exponent));
}

template class RayWalk<double>;
template class RayWalk<float>;

}  // namespace kios
