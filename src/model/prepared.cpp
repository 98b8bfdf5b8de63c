// SPDX-FileCopyrightText: 2026 The fcl_kios authors
// SPDX-License-Identifier: BSD-3-Clause
#include "model/prepared.h"

#include <typeinfo>
#include <utility>
#include <vector>

#include "fcl_kios/model/prepare.h"
#include "model/kios_model.h"
#include "search/search.h"
#include "tree/prepare.h"
#include "tree/refit.h"
#include "volume/errors.h"
#include "volume/instantiate.h"

namespace kios {

template <typename S>
[[gnu::hot]] engine::TreeCache* treesOf(const Model<S>& model) {
  using Fitter = fcl::detail::BVFitter<kIOS<S>>;
  const auto* const fitter = model.bv_fitter.get();
  if (!fitter) return nullptr;
  if (detail::areSame(typeid(*fitter), typeid(Fitter)))
    return static_cast<const Fitter*>(fitter)->trees_.get();
  const auto* const derived = dynamic_cast<const Fitter*>(fitter);
  return derived ? derived->trees_.get() : nullptr;
}

template <typename S>
[[gnu::hot]] engine::TreeCache::Use preparedTree(const Model<S>& model) {
  engine::TreeCache* const trees = treesOf(model);
  const kIOS<S>& root = model.getBV(0).bv;
  if (!trees || root.stamp == 0) return {};
  const double radius = root.radius0;
  if (!(radius >= engine::kLeastReach && radius <= engine::kLargestReach)) return {};
  const engine::MeshView<S> mesh = viewOf(model);
  const engine::TreeKey key = keyOf(model);
  if (engine::TreeCache::Use found = trees->find(key); found.isKnown()) return found;
  return trees->findOrMake(key, [&](engine::SharedTree old) {
    if (old && engine::refit(mesh, old.detach())) return old;
    return engine::SharedTree(engine::contentHash(mesh), [&] {
      return trees->isBuilt(root.stamp) ? engine::prepare(mesh, &model.getBV(0))
                                        : engine::prepare(mesh);
    });
  });
}

template <typename S>
[[gnu::hot]] bool copyRoot(const Model<S>& model, engine::TreeRoot& root) {
  const engine::TreeCache* const trees = treesOf(model);
  return trees && trees->findRoot(model.getBV(0).bv.stamp, root);
}

template <typename S>
engine::SharedTree purelyPreparedTree(const Model<S>& model) {
  const engine::TreeCache::Use kept = preparedTree(model);
  if (!kept) return {};
  // Nobody finds a refitted tree by its content.
  const engine::MeshView<S> mesh = viewOf(model);
  return {engine::contentHash(mesh), [&] { return engine::prepare(mesh, &model.getBV(0)); }};
}

template <typename S>
void takePrepared(const Model<S>& model, std::unique_ptr<engine::Tree> tree) {
  treesOf(model)->findOrMake(keyOf(model), [&](const engine::SharedTree& /*none*/) {
    return engine::SharedTree(engine::contentHash(viewOf(model)),
                              [&tree] { return std::move(tree); });
  });
}

template <typename S>
void prepare(const Model<S>& model) {
  requireFinished(model);
  preparedTree(model);
}

template <typename S>
std::size_t preparedBytes(const Model<S>& model) {
  engine::TreeCache* const trees = treesOf(model);
  return trees ? trees->bytes() : 0;
}

template <typename S>
void invalidate(Model<S>& model) {
  validate(model);
  const std::vector<fcl::Vector3<S>> vertices(model.vertices, model.vertices + model.num_vertices);
  int failed = 0;
  if (model.build_state == fcl::BVH_BUILD_STATE_UPDATED) {
    // FCL replaces no updated model. An update makes the current vertices the previous ones, which
    // they must not become: beginUpdateModel() swaps the arrays back.
    std::swap(model.vertices, model.prev_vertices);
    failed |= model.beginUpdateModel();
    failed |= model.updateSubModel(vertices);
    failed |= model.endUpdateModel(true, true);
  } else {
    failed |= model.beginReplaceModel();
    failed |= model.replaceSubModel(vertices);
    failed |= model.endReplaceModel(true, true);
  }
  if (failed != fcl::BVH_OK) {
    refuse<std::logic_error>("FCL refused to refit a finished model.");
  }
  if (engine::TreeCache* const trees = treesOf(model)) trees->drop(model.vertices);
}

const char* simdTarget() { return engine::kernels().target; }

KIOS_INSTANTIATE_FUNCTION(treesOf);
KIOS_INSTANTIATE_FUNCTION(preparedTree);
KIOS_INSTANTIATE_FUNCTION(copyRoot);
KIOS_INSTANTIATE_FUNCTION(purelyPreparedTree);
KIOS_INSTANTIATE_FUNCTION(takePrepared);
KIOS_INSTANTIATE_FUNCTION(prepare);
KIOS_INSTANTIATE_FUNCTION(preparedBytes);
KIOS_INSTANTIATE_FUNCTION(invalidate);

}  // namespace kios
