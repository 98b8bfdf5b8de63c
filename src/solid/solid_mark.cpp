// SPDX-FileCopyrightText: 2026 The fcl_kios authors
// SPDX-License-Identifier: BSD-3-Clause
#include "solid/solid_mark.h"

#include <stdexcept>
#include <typeinfo>

#include "fcl_kios/solid/solids.h"
#include "model/kios_model.h"
#include "model/prepared.h"
#include "solid/components.h"
#include "volume/errors.h"
#include "volume/instantiate.h"
#include "volume/stamp.h"

namespace kios {
namespace {

/// The cache that holds the model's mark, of no other model: copies share theirs until one of them
/// is marked or unmarked.
template <typename S>
engine::TreeCache& ownTrees(Model<S>& model) {
  using Fitter = fcl::detail::BVFitter<kIOS<S>>;
  engine::TreeCache* const trees = treesOf(model);
  if (!trees) refuse("a model can be marked only with the BVFitter of k-IOS; its own is another.");
  if (model.bv_fitter.use_count() == 1) return *trees;
  const auto& fitter = *model.bv_fitter;
  if (typeid(fitter) != typeid(Fitter)) {
    refuse("a model can be marked only with a BVFitter of its own; another model shares this one.");
  }
  const auto own = std::make_shared<Fitter>(static_cast<const Fitter&>(fitter).options());
  const std::uint64_t stamp = model.getNumBVs() > 0 ? model.getBV(0).bv.stamp : 0;
  model.bv_fitter = own;
  engine::TreeCache& own_trees = *treesOf(model);
  if (trees->isBuilt(stamp)) own_trees.noteBuilt(stamp);
  return own_trees;
}

}  // namespace

std::atomic<int> detail::num_solid_marks{0};

template <typename S>
SolidMark<S>::SolidMark() {
  ++detail::num_solid_marks;
}
template <typename S>
SolidMark<S>::~SolidMark() {
  --detail::num_solid_marks;
}

template <typename S>
SolidState<S>::SolidState(const Model<S>& model) {
  const Components<S> parts(viewOf(model));
  closedness_ = parts.closedness();
  for (int c = 0; c < closedness_.components; ++c) {
    Extremes extremes;
    extremes.fill(-1);
    for (const int t : parts.trianglesOf(c)) {
      for (int k = 0; k < 3; ++k) {
        const int vertex = static_cast<int>(model.tri_indices[t][k]);
        for (int e = 0; e < 6; ++e) {
          int& extreme = extremes[static_cast<std::size_t>(e)];
          const auto at = [&](int v) { return model.vertices[v][e / 2]; };
          const bool farther =
              extreme < 0 || (e % 2 == 0 ? at(vertex) < at(extreme) : at(vertex) > at(extreme));
          if (farther) extreme = vertex;
        }
      }
    }
    components_.push_back(extremes);
  }
}

template <typename S>
const Convexity& SolidState<S>::convexity(const Model<S>& model) const {
  std::call_once(convexity_known_, [&] {
    if (closedness_.components == 1) convexity_ = measureConvexity(model);
  });
  return convexity_;
}

template <typename S>
const InnerBalls& SolidState<S>::balls(const Model<S>& model) const {
  std::call_once(balls_known_, [&] { balls_ = innerBalls(model); });
  return balls_;
}

template <typename S>
std::shared_ptr<const SolidState<S>> SolidMark<S>::stateOf(const Model<S>& model) {
  const std::uint64_t stamp = model.getBV(0).bv.stamp;
  const std::lock_guard<std::mutex> lock(mutex_);
  for (const Known& known : known_) {
    if (known.stamp == stamp && known.state) return known.state;
  }
  auto state = std::make_shared<const SolidState<S>>(model);
  known_[next_] = {stamp, state};
  if (stamp != 0 && state->closedness().isSolid()) good_[next_] = stamp;
  next_ = (next_ + 1) % known_.size();
  return state;
}

template <typename S>
std::shared_ptr<const SolidState<S>> SolidMark<S>::require(const Model<S>& model) {
  auto state = stateOf(model);
  if (!state->closedness().isSolid()) {
    refuse("the model is marked as a solid, but was changed since, so that it is none: " +
           faultsOf(state->closedness()) + "; close it, or call kios::unmarkSolid().");
  }
  return state;
}

template <typename S>
SolidMark<S>* detail::findMark(const Model<S>& model) {
  const engine::TreeCache* const trees = treesOf(model);
  return trees ? static_cast<SolidMark<S>*>(trees->attachment.get()) : nullptr;
}

namespace {

template <typename S>
SolidMark<S>& requireMark(const Model<S>& model) {
  requireFinished(model);
  SolidMark<S>* const mark = markOf(model);
  if (!mark) refuse("the model is no solid: call kios::markSolid() first.");
  return *mark;
}

/// The model is a new one to all that remember its state, such as scenes.
template <typename S>
void stampAnew(Model<S>& model, engine::TreeCache& trees) {
  std::uint64_t& stamp = model.getBV(0).bv.stamp;
  const bool built = trees.isBuilt(stamp);
  stamp = nextStamp();
  if (built) trees.noteBuilt(stamp);
}

}  // namespace

template <typename S>
void checkSolid(const Model<S>& model) {
  requireMark(model).check(model);
}

template <typename S>
std::shared_ptr<const SolidState<S>> requireSolid(const Model<S>& model) {
  return requireMark(model).require(model);
}

template <typename S>
void markSolid(Model<S>& model) {
  validate(model);
  const Closedness<S> closedness = inspectClosedness(model);
  if (!closedness.isSolid()) {  // before anything changes
    refuse("the model bounds no solid: " + faultsOf(closedness) + ".");
  }
  engine::TreeCache& trees = ownTrees(model);
  stampAnew(model, trees);
  trees.attachment = std::make_unique<SolidMark<S>>();
}

template <typename S>
void unmarkSolid(Model<S>& model) {
  if (!markOf(model)) return;
  engine::TreeCache& trees = ownTrees(model);
  trees.attachment.reset();
  if (model.getNumBVs() > 0) stampAnew(model, trees);
}

template <typename S>
bool isSolid(const Model<S>& model) {
  SolidMark<S>* const mark = markOf(model);
  if (!mark) return false;
  try {
    requireFinished(model);
  } catch (const std::invalid_argument&) {
    return false;
  }
  return mark->stateOf(model)->closedness().isSolid();
}

KIOS_INSTANTIATE_CLASS(SolidState);
KIOS_INSTANTIATE_CLASS(SolidMark);
KIOS_INSTANTIATE_FUNCTION(detail::findMark);
KIOS_INSTANTIATE_FUNCTION(checkSolid);
KIOS_INSTANTIATE_FUNCTION(requireSolid);
KIOS_INSTANTIATE_FUNCTION(markSolid);
KIOS_INSTANTIATE_FUNCTION(unmarkSolid);
KIOS_INSTANTIATE_FUNCTION(isSolid);

}  // namespace kios
