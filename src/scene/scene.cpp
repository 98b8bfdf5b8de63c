// SPDX-FileCopyrightText: 2026 The fcl_kios authors
// SPDX-License-Identifier: BSD-3-Clause
#include "scene/scene.h"

#include <algorithm>
#include <utility>

#include "model/kios_model.h"
#include "volume/errors.h"

namespace kios::scene {

template <typename S>
int Scene<S>::add(Body<S> body) {
  int id = static_cast<int>(bodies_.size());
  watch(body.model);
  if (!free_.empty()) {
    id = *free_.begin();
    free_.erase(free_.begin());
  } else {
    try {
      bodies_.emplace_back();
    } catch (...) {
      unwatch(body.model);
      throw;
    }
  }
  bodies_[id] = std::move(body);
  tree_stale_ = true;
  return id;
}

template <typename S>
void Scene<S>::remove(int id) {
  const Model<S>* const model = body(id).model;
  free_.insert(id);  // the only step that may throw
  unwatch(model);
  bodies_[id] = Body<S>();
  for (auto it = excluded_.begin(); it != excluded_.end();) {
    const int a = static_cast<int>(*it >> 32), b = static_cast<int>(*it & 0xffffffffU);
    it = a == id || b == id ? excluded_.erase(it) : std::next(it);
  }
  tree_stale_ = true;
}

template <typename S>
void Scene<S>::watch(const Model<S>* model) {
  if (!model) return;
  Watch& watch = watches_[model];
  if (watch.users++ == 0) watch.key = keyOf(*model);
}

template <typename S>
void Scene<S>::unwatch(const Model<S>* model) {
  const auto found = watches_.find(model);
  if (found != watches_.end() && --found->second.users == 0) watches_.erase(found);
}

template <typename S>
Body<S>& Scene<S>::body(int id) {
  if (!contains(id)) refuse("the scene has no object ", id, ".");
  return bodies_[id];
}

template <typename S>
void Scene<S>::exclude(int a, int b, bool excluded) {
  body(a);
  body(b);
  if (a == b) {
    refuse("the object ", a, " makes no pair with itself, which could be excluded.");
  }
  if (excluded) {
    excluded_.insert(keyOfEither(a, b));
  } else {
    excluded_.erase(keyOfEither(a, b));
  }
}

template <typename S>
bool Scene<S>::admissible(int a, int b) const {
  if (obstacles(a, b)) return false;
  if (!excluded_.empty() && excluded_.count(keyOfEither(a, b)) != 0) return false;
  return !filter || filter(a, b);
}

template <typename S>
void Scene<S>::follow(Body<S>& body) {
  const auto& geometry = body.followed->collisionGeometry();
  if (geometry == body.geometry) {
    move(body, body.followed->getTransform());
    return;
  }
  Body<S> placed = body;
  place<S>(placed, geometry, body.followed->getTransform());
  watch(placed.model);
  unwatch(body.model);
  body = std::move(placed);
}

template <typename S>
bool Scene<S>::modelsChanged() {
  for (const auto& watched : watches_) requireFinished(*watched.first);
  bool changed = false;
  for (auto& [model, watch] : watches_) {
    const engine::TreeKey key = keyOf(*model);
    watch.changed = !(key == watch.key);
    watch.key = key;
    changed |= watch.changed;
  }
  return changed;
}

template <typename S>
void Scene<S>::beginQuery() {
  counts = SceneCounts();
  counts.total = static_cast<long long>(size()) * (static_cast<long long>(size()) - 1) / 2;
  double error = 0;
  num_obstacles_ = 0;
  for (Body<S>& body : bodies_) {
    if (!body.used()) continue;
    if (body.followed) follow(body);
    if (body.shape) renewIfChanged(body);
    error = std::max(error, body.rotation_error);
    num_obstacles_ += body.role == Role::kObstacle ? 1 : 0;
  }
  if (modelsChanged()) {
    for (Body<S>& body : bodies_) {
      if (body.model && watches_.at(body.model).changed) renew(body);
    }
  }
  box_share_ = 1 - boxShare<S>(error);
  near_.follow(bodies_);
  memory.beginQuery();
}

template <typename S>
void Scene<S>::updateTree() {
  if (!tree_stale_) {
    tree_stale_ = !tree_.refit([this](int id) -> const Box& { return bodies_[id].box; });
  }
  if (tree_stale_) {
    std::vector<BoxTree::Leaf> leaves;
    leaves.reserve(size());
    for (int id = 0; id < static_cast<int>(bodies_.size()); ++id) {
      const Body<S>& body = bodies_[id];
      if (body.used()) leaves.push_back({id, body.box, body.role == Role::kObstacle});
    }
    tree_.build(std::move(leaves));
  }
  tree_stale_ = false;
}

template class Scene<double>;
template class Scene<float>;

}  // namespace kios::scene
