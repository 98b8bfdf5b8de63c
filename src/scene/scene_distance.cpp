// SPDX-FileCopyrightText: 2026 The fcl_kios authors
// SPDX-License-Identifier: BSD-3-Clause
#include "fcl_kios/scene/scene_distance.h"

#include <utility>

#include "scene/scene.h"
#include "volume/errors.h"

namespace kios {

template <typename S>
class SceneDistance<S>::Impl : public scene::Scene<S> {};

template <typename S>
SceneDistance<S>::SceneDistance() : impl_(std::make_unique<Impl>()) {}
template <typename S>
SceneDistance<S>::~SceneDistance() = default;
template <typename S>
SceneDistance<S>::SceneDistance(SceneDistance&&) noexcept = default;
template <typename S>
SceneDistance<S>& SceneDistance<S>::operator=(SceneDistance&&) noexcept = default;

template <typename S>
int SceneDistance<S>::add(std::shared_ptr<const Geometry> geometry, const Pose& X_W, Role role) {
  scene::Body<S> body;
  scene::place(body, std::move(geometry), X_W);
  body.role = role;
  return impl_->add(std::move(body));
}

template <typename S>
int SceneDistance<S>::add(const fcl::CollisionObject<S>* object, Role role) {
  if (!object) refuse("an object added to a scene is null.");
  scene::Body<S> body;
  scene::place<S>(body, object->collisionGeometry(), object->getTransform());
  body.followed = object;
  body.role = role;
  return impl_->add(std::move(body));
}

template <typename S>
void SceneDistance<S>::remove(int id) {
  impl_->remove(id);
}

template <typename S>
void SceneDistance<S>::move(int id, const Pose& X_W) {
  scene::Body<S>& body = impl_->body(id);
  if (body.followed) {
    refuse("the pose of an object added as an fcl::CollisionObject is read from that.");
  }
  scene::move(body, X_W);
}

template <typename S>
void SceneDistance<S>::changed(int id) {
  scene::Body<S>& body = impl_->body(id);
  scene::renew(body);
}

template <typename S>
bool SceneDistance<S>::contains(int id) const {
  return impl_->contains(id);
}

template <typename S>
std::size_t SceneDistance<S>::size() const {
  return impl_->size();
}

template <typename S>
void SceneDistance<S>::exclude(int a, int b, bool excluded) {
  impl_->exclude(a, b, excluded);
}

template <typename S>
void SceneDistance<S>::setFilter(const Filter& filter) {
  impl_->filter = filter;
}

template <typename S>
std::optional<ScenePair<S>> SceneDistance<S>::closestPair(const SceneRequest& request) {
  return impl_->closestPair(request);
}

template <typename S>
std::vector<ScenePair<S>> SceneDistance<S>::pairsWithin(S margin, const SceneRequest& request) {
  if (!(margin == margin)) refuse("a margin is NaN.");
  return impl_->pairsWithin(margin, request);
}

template <typename S>
std::vector<ScenePair<S>> SceneDistance<S>::clearances(const SceneRequest& request) {
  return impl_->clearances(request);
}

template <typename S>
const SceneCounts& SceneDistance<S>::counts() const {
  return impl_->counts;
}

template <typename S>
std::size_t SceneDistance<S>::rememberedPairs() const {
  return impl_->memory.size();
}

template <typename S>
void SceneDistance<S>::forget() {
  impl_->memory.clear();
}

template class SceneDistance<double>;
template class SceneDistance<float>;

}  // namespace kios
