// SPDX-FileCopyrightText: 2026 The fcl_kios authors
// SPDX-License-Identifier: BSD-3-Clause
#include "fcl_kios/scene.h"

#include <algorithm>
#include <limits>
#include <utility>

#include "scene/content.h"
#include "scene/scene.h"
#include "volume/errors.h"
#include "volume/rounding.h"

namespace kios {

namespace {

template <typename S>
ScenePair<S> inScalar(const ScenePaird& pair) {
  return {pair.a,
          pair.b,
          roundedTo<S>(pair.distance),
          pair.triangle_a,
          pair.triangle_b,
          roundedTo<S>(pair.nearest_a),
          roundedTo<S>(pair.nearest_b)};
}

template <typename S>
std::vector<ScenePair<S>> inScalar(const std::vector<ScenePaird>& pairs) {
  std::vector<ScenePair<S>> rounded;
  rounded.reserve(pairs.size());
  for (const ScenePaird& pair : pairs) rounded.push_back(inScalar<S>(pair));
  return rounded;
}

}  // namespace

template <typename S>
class SceneDistance<S>::Impl : public scene::Scene {};

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
  return impl_->add(scene::makeBody<S>(std::move(geometry), X_W), role);
}

template <typename S>
int SceneDistance<S>::add(const fcl::CollisionObject<S>* object, Role role) {
  if (!object) refuse("an object added to a scene is null.");
  return impl_->add(scene::makeBody(*object), role);
}

template <typename S>
void SceneDistance<S>::remove(int id) {
  impl_->remove(id);
}

template <typename S>
void SceneDistance<S>::move(int id, const Pose& X_W) {
  scene::Body& body = impl_->body(id);
  if (body.content->isFollowed()) {
    refuse("the pose of an object added as an fcl::CollisionObject is read from that.");
  }
  scene::move(body, X_W);
}

template <typename S>
void SceneDistance<S>::changed(int id) {
  scene::Body& body = impl_->body(id);
  body.content->renew(body);
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
void SceneDistance<S>::ignorePair(int a, int b, bool ignored) {
  impl_->ignorePair(a, b, ignored);
}

template <typename S>
void SceneDistance<S>::setFilter(const Filter& filter) {
  impl_->filter = filter;
}

template <typename S>
std::optional<ScenePair<S>> SceneDistance<S>::closestPair(const SceneRequest& request) {
  const std::optional<ScenePaird> pair = impl_->closestPair(request);
  return pair ? std::optional(inScalar<S>(*pair)) : std::nullopt;
}

template <typename S>
std::vector<ScenePair<S>> SceneDistance<S>::pairsWithin(S margin, const SceneRequest& request) {
  if (!(margin == margin)) refuse("a margin is NaN.");
  const double most = std::min(margin, std::numeric_limits<S>::max());
  return inScalar<S>(impl_->pairsWithin(most, request));
}

template <typename S>
std::vector<ScenePair<S>> SceneDistance<S>::clearances(const SceneRequest& request) {
  return inScalar<S>(impl_->pairsWithin(kInfinity, request));
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
